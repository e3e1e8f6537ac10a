// SPDX-License-Identifier: MIT
// The conditions C1 to C4 of the certificate, each broken by itself. A surface is drawn as rows of
// letters, one letter for each vertex of T: the region that it is in; a capital is the region's
// site. The vertices of a region lie around its site as they lie in the drawing, and regions lie
// far apart, so that nearest sites give just these labels.
#include "recover/certificate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contour/mesh_checks.h"
#include "mesh/tri_mesh.h"
#include "recover/labels.h"

using namespace deliso;

namespace {

using Rows = std::vector<std::string>;

// What the rows are: a disk whose rim lies on the box, or a sphere, with a vertex beyond the first
// row and one beyond the last, whose letters these are.
struct Drawing {
  Rows rows;
  std::string poles;  // empty: a disk

  bool is_sphere() const { return !poles.empty(); }
  int height() const { return static_cast<int>(rows.size()); }
  int width() const { return static_cast<int>(rows[0].size()); }
  VertexId at(int row, int column) const { return VertexId(row * width() + column % width()); }
  VertexId pole(int n) const { return VertexId(height() * width() + n); }
  std::string letters() const {
    std::string all;
    for (const std::string& row : rows) all += row;
    return all + poles;
  }
};

std::vector<Triangle> triangles_of(const Drawing& d) {
  std::vector<Triangle> triangles;
  const int columns = d.is_sphere() ? d.width() : d.width() - 1;
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r + 1 < d.height(); ++r) {
      triangles.push_back({d.at(r, c), d.at(r + 1, c), d.at(r, c + 1)});
      triangles.push_back({d.at(r, c + 1), d.at(r + 1, c), d.at(r + 1, c + 1)});
    }
    if (!d.is_sphere()) continue;
    triangles.push_back({d.pole(0), d.at(0, c), d.at(0, c + 1)});
    triangles.push_back({d.pole(1), d.at(d.height() - 1, c + 1), d.at(d.height() - 1, c)});
  }
  return triangles;
}

// Where the vertex lies in the drawing as seen from another; rows are a little further apart, so
// that few vertices are as far.
Vec3 offset(const Drawing& d, VertexId from, VertexId to) {
  const auto row = [&](VertexId v) {
    if (v == d.pole(0)) return -1;
    return v == d.pole(1) ? d.height() : static_cast<int>(v) / d.width();
  };
  int columns = 0;
  if (std::max(from, to) < d.pole(0)) {
    columns = static_cast<int>(to) % d.width() - static_cast<int>(from) % d.width();
    if (d.is_sphere() && 2 * columns > d.width()) columns -= d.width();
    if (d.is_sphere() && 2 * columns < -d.width()) columns += d.width();
  }
  return {0.1 * columns, 0.11 * (row(to) - row(from)), 0};
}

// Triangles and their labels: one letter for each vertex of T.
struct Shape {
  std::string letters;
  std::vector<Triangle> triangles;
  std::vector<Vec3> offsets;  // of each vertex from its site

  VertexId site(VertexId v) const {
    const char name = static_cast<char>(std::toupper(letters[v]));
    const std::size_t site = letters.find(name);
    REQUIRE(site != std::string::npos);
    return VertexId(site);
  }
};

Shape shape_of(const Drawing& d) {
  Shape shape{d.letters(), triangles_of(d), {}};
  for (VertexId v = 0; v < shape.letters.size(); ++v) {
    shape.offsets.push_back(offset(d, shape.site(v), v));
  }
  return shape;
}

Shape shape_of(const std::string& letters, std::vector<Triangle> triangles) {
  Shape shape{letters, std::move(triangles), {}};
  for (VertexId v = 0; v < letters.size(); ++v) {
    const double steps = static_cast<double>(v) - static_cast<double>(shape.site(v));
    shape.offsets.push_back({0.1 * steps, 0, 0});
  }
  return shape;
}

// Where boundary edges lead, as the triangles run.
std::map<VertexId, VertexId> boundary_of(const std::vector<Triangle>& triangles) {
  std::map<VertexId, VertexId> next;
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  }
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) next[a] = b;
  }
  return next;
}

// Its boundary lies on the box.
ContourMesh contour_of(const Shape& shape) {
  ContourMesh t;
  for (VertexId v = 0; v < shape.letters.size(); ++v) {
    const double n = std::toupper(shape.letters[v]) - 'A';
    t.points.push_back(Vec3{10 * n, n * n, n * n * n} + shape.offsets[v]);
  }
  t.component.assign(t.points.size(), 0);
  t.box_faces.assign(t.points.size(), 0);
  t.triangles = shape.triangles;
  t.summary.components.resize(1);
  for (const auto& [a, b] : boundary_of(t.triangles)) t.box_faces[a] = 1;
  return t;
}

// T with its sites, which may become more.
class Labelled {
 public:
  explicit Labelled(const Drawing& drawing) : Labelled(shape_of(drawing)) {}
  explicit Labelled(const Shape& shape)
      : letters_(shape.letters),
        contour_(contour_of(shape)),
        triangulation_(first_sites()),
        labels_(contour_, triangulation_, std::vector<std::uint8_t>{1}, 1),
        certificate_(labels_) {
    for (VertexId v = 0; v < letters_.size(); ++v) {
      REQUIRE(vertex_[labels_.label(v)] == shape.site(v));
    }
  }

  Verdict check(VertexId v) { return certificate_.check(labels_.label(v), v, scratch_, facets_); }
  Verdict check(char site) { return check(VertexId(letters_.find(site))); }

  // The sites that break a condition.
  std::string broken() {
    std::string names;
    for (const VertexId v : vertex_) {
      if (v != kNoId && check(v).violation) names += letters_[v];
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  void insert(VertexId v) {
    REQUIRE(v != kNoId);
    ConflictZone zone;
    std::vector<CellId> created;
    triangulation_.find_conflicts(contour_.points[v], kNoId, zone);
    REQUIRE(zone.duplicate == kNoId);
    const SiteId site = triangulation_.insert_in_zone(contour_.points[v], zone, created);
    std::vector<SiteId> neighbors;
    for (SiteId s = 1; s < site; ++s) neighbors.push_back(s);
    labels_.add_site(site, neighbors);
    vertex_.push_back(v);
  }

  // Inserts what the certificate names until it holds; the number of insertions.
  int settle() {
    int insertions = 0;
    for (bool any = true; any;) {
      any = false;
      for (VertexId s = 1; s < vertex_.size(); ++s) {
        if (vertex_[s] == kNoId) continue;
        const Verdict verdict = check(vertex_[s]);
        if (!verdict.violation) continue;
        insert(verdict.insert);
        any = true;
        ++insertions;
      }
    }
    return insertions;
  }

  // The conditions that are broken at any site.
  std::set<Reason> broken_conditions() {
    std::set<Reason> reasons;
    for (const VertexId v : vertex_) {
      if (v == kNoId) continue;
      if (const auto violation = check(v).violation) reasons.insert(*violation);
    }
    return reasons;
  }

  // Every site is a vertex, also one without facets.
  ContourMesh dual() {
    ContourMesh dual;
    std::vector<VertexId> number(vertex_.size(), kNoId);
    for (const VertexId v : vertex_) {
      if (v == kNoId) continue;
      number[labels_.label(v)] = VertexId(dual.points.size());
      dual.points.push_back(contour_.points[v]);
      dual.box_faces.push_back(contour_.box_faces[v]);
    }
    for (const VertexId v : vertex_) {
      if (v == kNoId) continue;
      check(v);
      for (const DualFacet& f : facets_) {
        if (f.sites[1] < f.sites[0] || f.sites[2] < f.sites[0]) continue;
        dual.triangles.push_back({number[f.sites[0]], number[f.sites[1]], number[f.sites[2]]});
      }
    }
    return dual;
  }

  bool has_facets_at_all_sites() {
    std::set<VertexId> corners;
    const ContourMesh k = dual();
    for (const Triangle& t : k.triangles) corners.insert(t.begin(), t.end());
    return corners.size() == k.points.size();
  }

  // What the dual lacks of being a surface like T, as docs/proof.md, Theorem 2, promises it: with
  // the sites on the box as its boundary, in T's order. Empty if it lacks nothing.
  std::string fault_of_dual() {
    const ContourMesh k = dual();
    const std::string fault = check_manifold(k);
    if (!fault.empty()) return fault;
    std::set<Triangle> facets;
    for (Triangle t : k.triangles) {
      std::sort(t.begin(), t.end());
      if (!facets.insert(t).second) return "a facet twice";
    }
    const MeshTopology is = measure_topology(k), wanted = measure_topology(contour_);
    if (is.components != wanted.components || is.euler != wanted.euler ||
        is.boundary_loops != wanted.boundary_loops) {
      return "another topology";
    }
    const std::map<VertexId, VertexId> next = boundary_of(contour_.triangles);
    std::vector<VertexId> at;  // per vertex of the dual, its vertex of T
    std::ranges::copy_if(vertex_, std::back_inserter(at), [](VertexId v) { return v != kNoId; });
    for (const auto& [a, b] : boundary_of(k.triangles)) {
      VertexId v = next.at(at[a]);
      while (!labels_.is_site(v)) v = next.at(v);
      if (v != at[b]) return "the boundary in another order";
    }
    return "";
  }

 private:
  // Every capital, and four corners that hold the triangulation together.
  Triangulation first_sites() {
    std::vector<Vec3> points;
    std::vector<VertexId> at;
    for (VertexId v = 0; v < letters_.size(); ++v) {
      if (!std::isupper(letters_[v])) continue;
      points.push_back(contour_.points[v]);
      at.push_back(v);
    }
    for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
      points.push_back(1e5 * corner);
    }
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    vertex_.assign(t.vertex_capacity(), kNoId);
    for (std::size_t n = 0; n < at.size(); ++n) vertex_[ids[n]] = at[n];
    return t;
  }

  std::string letters_;
  ContourMesh contour_;
  std::vector<VertexId> vertex_;  // per site, its vertex of T
  Triangulation triangulation_;
  Labels labels_;
  Certificate certificate_;
  Certificate::Scratch scratch_;
  std::vector<DualFacet> facets_;
};

// The site breaks that condition, and so do those of `broken` and no others; the vertex of T that
// is named is the one wanted; and when that and what is named then have been inserted, the dual is
// a mesh of T's topology.
void check_broken(const Drawing& drawing, char site, Reason violation, VertexId named,
                  const std::string& broken) {
  Labelled t(drawing);
  CHECK(t.broken() == broken);
  const Verdict verdict = t.check(site);
  CHECK(verdict.violation == violation);
  REQUIRE(verdict.insert == named);
  t.insert(named);
  CHECK(t.settle() < static_cast<int>(drawing.letters().size()) / 2);
  CHECK(t.broken().empty());
  CHECK(t.fault_of_dual() == "");
}

// That condition alone is broken, at these sites; the dual is no surface like T, though every site
// is one of its vertices; and when what is named has been inserted, it is.
void check_alone(const Shape& shape, Reason violation, const std::string& broken) {
  Labelled t(shape);
  CHECK(t.broken() == broken);
  CHECK(t.broken_conditions() == std::set{violation});
  CHECK(t.has_facets_at_all_sites());
  CHECK(t.fault_of_dual() != "");
  t.settle();
  CHECK(t.fault_of_dual() == "");
}

using Triangles = std::vector<Triangle>;

// Each region with a site, on the boundary if it has a vertex there.
std::string with_sites(std::string letters, const Triangles& triangles) {
  const std::map<VertexId, VertexId> boundary = boundary_of(triangles);
  for (char name = 'a'; name <= 'z'; ++name) {
    std::size_t site = letters.find(name);
    if (site == std::string::npos) continue;
    for (std::size_t v = site; v < letters.size(); ++v) {
      const bool is_better = boundary.contains(VertexId(v)) && !boundary.contains(VertexId(site));
      if (letters[v] == name && is_better) site = v;
    }
    letters[site] = static_cast<char>(std::toupper(name));
  }
  return letters;
}

// What breaks C1 to C4 at a site, counted as recover/certificate.h says it, over all of T; but not
// that the site is on the boundary.
std::set<Reason> conditions_broken(const std::string& letters, const Triangles& triangles,
                                   char site) {
  const char a = static_cast<char>(std::tolower(site));
  using Names = std::set<char>;
  std::set<std::set<VertexId>> edges;
  std::map<Names, int> edges_of, rim_of, triangles_of;  // by the labels of their corners
  const auto names = [&](const auto& corners) {
    Names all;
    for (const VertexId v : corners) all.insert(letters[v]);
    return all;
  };
  for (const Triangle& t : triangles) {
    ++triangles_of[names(t)];
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  }
  std::set<VertexId> on_rim;
  for (const auto& [v, w] : boundary_of(triangles)) {
    ++rim_of[names(std::array{v, w})];
    if (letters[v] == a) on_rim.insert(v);
  }
  std::vector<VertexId> root(letters.size());
  for (VertexId v = 0; v < root.size(); ++v) root[v] = v;
  for (const auto& e : edges) {
    ++edges_of[names(e)];
    if (names(e).size() > 1) continue;
    std::ranges::replace(root, VertexId(root[*e.begin()]), VertexId(root[*e.rbegin()]));
  }
  std::set<VertexId> pieces;
  for (VertexId v = 0; v < root.size(); ++v) {
    if (letters[v] == a) pieces.insert(root[v]);
  }
  std::set<Reason> broken;
  const auto vertices = std::ranges::count(letters, a);
  if (pieces.size() != 1 || vertices - edges_of[{a}] + triangles_of[{a}] != 1) {
    broken.insert(Reason::region);
  }
  const auto boundary_vertices = static_cast<int>(on_rim.size());
  if (boundary_vertices > 0 && boundary_vertices - rim_of[{a}] != 1) {
    broken.insert(Reason::boundary);
  }
  for (const auto& [both, count] : edges_of) {
    if (both.size() != 2 || !both.contains(a)) continue;
    if (count - triangles_of[both] != 1) broken.insert(Reason::interface);
    if (rim_of[both] > 1) broken.insert(Reason::boundary);
  }
  for (const auto& [all, count] : triangles_of) {
    if (all.size() == 3 && all.contains(a) && count > 1) broken.insert(Reason::triple);
  }
  return broken;
}

// All spheres of n vertices: what flips make of one, as sorted triangles that begin with their
// smallest vertex.
std::set<Triangles> spheres(VertexId n) {
  const auto sorted = [](Triangles triangles) {
    for (Triangle& t : triangles)
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  Triangles first{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  for (VertexId v = 4; v < n; ++v) {
    const auto [a, b, c] = first.back();
    first.pop_back();
    first.insert(first.end(), {{a, b, v}, {b, c, v}, {c, a, v}});
  }
  std::vector<Triangles> queue{sorted(first)};
  std::set<Triangles> found(queue.begin(), queue.end());
  while (!queue.empty()) {
    const Triangles from = queue.back();
    queue.pop_back();
    std::map<std::pair<VertexId, VertexId>, VertexId> across;
    for (const Triangle& t : from) {
      for (std::size_t i = 0; i < 3; ++i) across[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    }
    for (const auto& [edge, c] : across) {
      const auto [a, b] = edge;
      const VertexId d = across.at({b, a});
      if (a > b || across.contains({c, d})) continue;
      Triangles to{{a, d, c}, {d, b, c}};
      for (const Triangle& t : from) {
        if (!has_corner(t, a) || !has_corner(t, b)) to.push_back(t);
      }
      to = sorted(to);
      if (found.insert(to).second) queue.push_back(to);
    }
  }
  return found;
}

// Labels of n vertices: a, ..., a, b, ..., b, c, ... for all ascending numbers of each. Up to the
// order of the vertices there are no others.
void add_labels(std::size_t n, std::size_t least, const std::string& begun,
                std::vector<std::string>& all) {
  if (n == 0) all.push_back(begun);
  const char letter = static_cast<char>(begun.empty() ? 'a' : begun.back() + 1);
  for (std::size_t m = least; m <= n; ++m)
    add_labels(n - m, m, begun + std::string(m, letter), all);
}

}  // namespace

TEST_CASE("where every condition holds the dual is a mesh already") {
  Labelled sphere({{"AabbCc", "aabbcc", "aaBbcc", "dddddd"}, "aD"});
  CHECK(sphere.broken().empty());
  CHECK(sphere.fault_of_dual() == "");
  Labelled disk({{"AabB", "aabb", "aCcb", "cccc"}, ""});
  CHECK(disk.broken() == "C");  // its site is not on the box
  Labelled mended({{"AabB", "aabb", "accb", "cCcc"}, ""});
  CHECK(mended.broken().empty());
  CHECK(mended.fault_of_dual() == "");
}

// The vertex furthest from the site is another one than the furthest of the stray piece: that the
// numbers of vertices, edges and facets do not fit either must not decide.
TEST_CASE("C1: a region in two pieces, and the furthest vertex of the stray one") {
  const Drawing sphere{{"AbaabCcc", "abbbbccc", "abbBbccc", "abbbbccc", "abbbbccc"}, "cb"};
  check_broken(sphere, 'A', Reason::region, sphere.at(0, 3), "ABC");
  const Drawing disk{{"AbaabB", "abbbbb", "abbbbb", "abbbbb", "abbbbb"}, ""};
  check_broken(disk, 'A', Reason::region, disk.at(0, 3), "AB");
}

// Three regions fill the hole, so that each meets the one around it in one arc.
TEST_CASE("C1: a region with a hole") {
  const Drawing belt{{"bbCcDd", "Aaaaaa", "eeFfGg"}, "BE"};
  check_broken(belt, 'A', Reason::region, belt.at(1, 3), "A");
  const Drawing disk{{"Eeeeffff",  //
                      "eaaaaaaf",  //
                      "eabbccaf",  //
                      "eaBddCaf",  //
                      "eaaDaaaf",  //
                      "eaaAaaaF"},
                     ""};
  check_broken(disk, 'A', Reason::region, disk.at(1, 6), "A");
}

TEST_CASE("C2: two regions that meet twice, with other regions at the ends") {
  const Drawing sphere{{"cCcceEee", "BbAaaabb", "bbaaaabb", "dDddfFff"}, "cd"};
  check_broken(sphere, 'A', Reason::interface, sphere.at(2, 5), "AB");
  const Drawing disk{{"Aaaabbbb",  //
                      "aaaabbbB",  //
                      "aaeeEebb",  //
                      "aaffFfbb",  //
                      "aaaabbbb",  //
                      "aaaabbbb",  //
                      "Dddddddd"},
                     ""};
  check_broken(disk, 'A', Reason::interface, disk.at(5, 3), "AB");
}

// Where a region on the box is a disk, its rim has an arc on the box; there two neighbours with an
// interface each can follow each other only once. So the region at which this condition alone is
// broken lies within, and on the box are the other two, which break C4.
TEST_CASE("C3: a triple on two triangles") {
  const Drawing sphere{{"AaBbcC", "aabbcc"}, "aa"};
  check_broken(sphere, 'A', Reason::triple, sphere.pole(1), "ABC");
  const Drawing disk{{"Aaaaccc",  //
                      "aaBbbcC",  //
                      "aabbbcc",  //
                      "aaaaccc"},
                     ""};
  check_broken(disk, 'B', Reason::triple, disk.at(3, 3), "ABC");
}

TEST_CASE("C4: a region on the box whose site is not there") {
  const Drawing disk{{"BbbccC", "baaaac", "baAaac", "baaaac"}, ""};
  check_broken(disk, 'A', Reason::boundary, disk.at(3, 4), "A");
}

TEST_CASE("C4: a region that meets the box in two arcs") {
  const Drawing disk{{"BbAacC", "bbaacc", "ddaaee", "DdaaeE"}, ""};
  check_broken(disk, 'A', Reason::boundary, disk.at(3, 3), "A");
}

TEST_CASE("C4: two regions that meet in two edges on the box") {
  const Drawing disk{{"AaBb", "aabb", "aabb"}, ""};
  check_broken(disk, 'A', Reason::boundary, disk.at(2, 1), "AB");
}

// The pictures of docs/proof.md.
TEST_CASE("C1: the smallest labels that break it alone") {
  check_alone(
      shape_of("aaaABC", {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}}),
      Reason::region, "A");
}

TEST_CASE("C2: the smallest labels that break it alone") {
  check_alone(
      shape_of("ABCaDE",
               {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}, {4, 3, 5}}),
      Reason::interface, "AB");
}

TEST_CASE("C3: the smallest labels that break it alone") {
  check_alone(shape_of("AaBC", {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}), Reason::triple,
              "ABC");
}

TEST_CASE("C4: the smallest labels that break it alone") {
  check_alone(shape_of("ABCbDE", {{0, 2, 1}, {1, 2, 3}, {1, 3, 4}, {4, 3, 5}}), Reason::boundary,
              "B");
}

TEST_CASE("labels without a dual facet: one region or two that are a whole sphere or disk") {
  const Triangles sphere{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, disk{{0, 1, 2}};
  const auto check = [](const std::string& letters, const Triangles& triangles, Reason violation) {
    CAPTURE(letters);
    Labelled t(shape_of(letters, triangles));
    CHECK(t.dual().triangles.empty());
    CHECK(t.broken_conditions() == std::set{violation});
    t.settle();
    CHECK(t.fault_of_dual() == "");
  };
  check("Aaaa", sphere, Reason::region);
  check("AaBb", sphere, Reason::interface);
  check("Aaa", disk, Reason::boundary);
  check("AaB", disk, Reason::boundary);
}

// Theorem 2 of docs/proof.md, and that its pictures are the smallest: there is no annulus of fewer
// than six vertices.
TEST_CASE("all labels of all small spheres and disks: where the certificate holds K is like T") {
  std::map<Reason, std::size_t> smallest;  // that break this alone, with all sites in facets
  std::map<Reason, int> told;
  int certified = 0;
  const auto look_at = [&](const std::string& labels, const Triangles& triangles) {
    const Shape shape = shape_of(with_sites(labels, triangles), triangles);
    CAPTURE(shape.letters);
    Labelled t(shape);
    std::set<Reason> broken;
    for (char site = 'A'; site <= std::toupper(labels.back()); ++site) {
      const std::set<Reason> here = conditions_broken(labels, triangles, site);
      const auto violation = t.check(site).violation;
      const bool is_right = violation ? here.contains(*violation) : here.empty();
      if (!is_right) FAIL_CHECK("another condition is broken at " << site);
      if (violation) ++told[*violation];
      broken.insert(here.begin(), here.end());
    }
    const std::string fault = t.fault_of_dual();
    if (broken.empty() && !fault.empty()) FAIL_CHECK(fault);
    certified += broken.empty();
    if (broken.size() != 1 || fault.empty() || !t.has_facets_at_all_sites()) return;
    const std::size_t before = smallest.insert({*broken.begin(), labels.size()}).first->second;
    smallest[*broken.begin()] = std::min(before, labels.size());
  };
  for (VertexId n = 4; n <= 7; ++n) {
    std::vector<std::string> of_sphere, of_disk;
    add_labels(n, 1, "", of_sphere);
    add_labels(n - 1, 1, "", of_disk);
    for (const Triangles& sphere : spheres(n)) {
      Triangles disk = sphere;
      std::erase_if(disk, [&](const Triangle& t) { return has_corner(t, VertexId(n - 1)); });
      for (const std::string& labels : of_disk) look_at(labels, disk);
      if (n == 7) continue;
      for (const std::string& labels : of_sphere) look_at(labels, sphere);
    }
  }
  CHECK(certified > 30000);
  for (const Reason r : {Reason::region, Reason::interface, Reason::triple, Reason::boundary}) {
    CHECK(told[r] > 100);
  }
  CHECK(smallest == std::map<Reason, std::size_t>{
                        {Reason::interface, 6}, {Reason::triple, 4}, {Reason::boundary, 6}});
}
