// SPDX-License-Identifier: MIT
// The conditions C1 to C4 of the certificate, each broken by itself. A surface is drawn as rows of
// letters, one letter for each vertex of T: the region that it is in; a capital is the region's
// site. The vertices of a region lie around its site as they lie in the drawing, and regions lie
// far apart, so that nearest sites give just these labels.
#include "recover/certificate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <map>
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

// The rim of a disk, as the triangles run.
std::vector<VertexId> rim_of(const Drawing& d) {
  std::vector<VertexId> rim;
  if (d.is_sphere()) return rim;
  const int last_row = d.height() - 1, last_column = d.width() - 1;
  for (int r = 0; r < last_row; ++r) rim.push_back(d.at(r, 0));
  for (int c = 0; c < last_column; ++c) rim.push_back(d.at(last_row, c));
  for (int r = last_row; r > 0; --r) rim.push_back(d.at(r, last_column));
  for (int c = last_column; c > 0; --c) rim.push_back(d.at(0, c));
  return rim;
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

ContourMesh contour_of(const Drawing& d) {
  const std::string letters = d.letters();
  ContourMesh t;
  for (VertexId v = 0; v < letters.size(); ++v) {
    const char name = static_cast<char>(std::toupper(letters[v]));
    const std::size_t site = letters.find(name);
    REQUIRE(site != std::string::npos);
    const double n = name - 'A';
    t.points.push_back(Vec3{10 * n, n * n, n * n * n} + offset(d, VertexId(site), v));
  }
  t.component.assign(t.points.size(), 0);
  t.box_faces.assign(t.points.size(), 0);
  t.triangles = triangles_of(d);
  t.summary.components.resize(1);
  const std::vector<VertexId> rim = rim_of(d);
  if (rim.empty()) return t;
  for (const VertexId v : rim) t.box_faces[v] = 1;
  t.boundary.vertices = rim;
  t.boundary.first.push_back(static_cast<std::uint32_t>(rim.size()));
  t.boundary.component.push_back(0);
  return t;
}

// T with its sites, which may become more.
class Labelled {
 public:
  explicit Labelled(const Drawing& drawing)
      : drawing_(drawing),
        contour_(contour_of(drawing)),
        triangulation_(first_sites()),
        labels_(contour_, triangulation_, std::vector<std::uint8_t>{1}, 1),
        certificate_(labels_) {
    const std::string letters = drawing.letters();
    for (VertexId v = 0; v < letters.size(); ++v) {
      const char name = static_cast<char>(std::toupper(letters[v]));
      REQUIRE(vertex_[labels_.label(v)] == letters.find(name));
    }
  }

  Verdict check(VertexId v) { return certificate_.check(labels_.label(v), v, scratch_, facets_); }
  Verdict check(char site) { return check(VertexId(drawing_.letters().find(site))); }

  // The sites that break a condition.
  std::string broken() {
    std::string names;
    for (const VertexId v : vertex_) {
      if (v != kNoId && check(v).violation) names += drawing_.letters()[v];
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

  // The dual of the labels has the topology of T, with every edge between one facet or two.
  void check_dual() {
    ContourMesh dual;
    std::vector<VertexId> number(vertex_.size(), kNoId);
    std::map<std::pair<VertexId, VertexId>, int> edges;
    for (const VertexId v : vertex_) {
      if (v == kNoId) continue;
      number[labels_.label(v)] = VertexId(dual.points.size());
      dual.points.push_back(contour_.points[v]);
    }
    for (const VertexId v : vertex_) {
      if (v == kNoId) continue;
      check(v);
      for (const DualFacet& f : facets_) {
        if (f.sites[1] < f.sites[0] || f.sites[2] < f.sites[0]) continue;
        dual.triangles.push_back({number[f.sites[0]], number[f.sites[1]], number[f.sites[2]]});
        const Triangle& t = dual.triangles.back();
        for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
      }
    }
    for (const auto& [edge, count] : edges) CHECK(count == 1);
    const MeshTopology is = measure_topology(dual), wanted = measure_topology(contour_);
    CHECK(is.components == wanted.components);
    CHECK(is.euler == wanted.euler);
    CHECK(is.boundary_loops == wanted.boundary_loops);
  }

 private:
  // Every capital, and four corners that hold the triangulation together.
  Triangulation first_sites() {
    std::vector<Vec3> points;
    std::vector<VertexId> at;
    const std::string letters = drawing_.letters();
    for (VertexId v = 0; v < letters.size(); ++v) {
      if (!std::isupper(letters[v])) continue;
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

  Drawing drawing_;
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
  t.check_dual();
}

}  // namespace

TEST_CASE("where every condition holds the dual is a mesh already") {
  Labelled sphere({{"AabbCc", "aabbcc", "aaBbcc", "dddddd"}, "aD"});
  CHECK(sphere.broken().empty());
  sphere.check_dual();
  Labelled disk({{"AabB", "aabb", "aCcb", "cccc"}, ""});
  CHECK(disk.broken() == "C");  // its site is not on the box
  Labelled mended({{"AabB", "aabb", "accb", "cCcc"}, ""});
  CHECK(mended.broken().empty());
  mended.check_dual();
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
