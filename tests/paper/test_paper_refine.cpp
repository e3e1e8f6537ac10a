// SPDX-License-Identifier: MIT
// Figure 9 and Figure 3: every insertion is held against all facets of the mesh.
#include "paper/refine.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "check/check_mesh.h"
#include "paper/poles.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::Refusal;
using paper::SurfaceMesh;

namespace {

using Side = std::pair<VertexId, VertexId>;

// The sides of `facets` that only one of them has, in its direction, with the facet across.
std::map<Side, FaceId> rim_of(const TriMesh& mesh, const std::set<FaceId>& facets) {
  std::map<Side, FaceId> rim;
  for (const FaceId f : facets) {
    const Face& face = mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.n[i] == kNoId || !facets.contains(face.n[i])) {
        rim[{face.v[(i + 1) % 3], face.v[(i + 2) % 3]}] = face.n[i];
      }
    }
  }
  return rim;
}

// A disk without inner vertices: each vertex has one side of the rim, and V - E + F is 1.
bool is_plain_disk(const TriMesh& mesh, const std::set<FaceId>& facets) {
  std::set<VertexId> corners, starts;
  const std::map<Side, FaceId> rim = rim_of(mesh, facets);
  for (const FaceId f : facets) {
    for (const VertexId v : mesh.faces[f].v) corners.insert(v);
  }
  for (const auto& [side, across] : rim) starts.insert(side.first);
  // Sides within are of two facets: E = (3 F + rim) / 2.
  const std::size_t edges = (3 * facets.size() + rim.size()) / 2;
  return starts.size() == rim.size() && corners == starts &&
         corners.size() + facets.size() == edges + 1;
}

// Follows RefineGeom, with pole heights of its own.
class RefineWatch : public paper::Observer {
 public:
  explicit RefineWatch(const Program& program)
      : program_(program), surface_(program.volume, program.sigma.kappa()) {}

  std::size_t asked = 0, cones = 0, not_a_disk = 0, at_curve = 0, near = 0, larger = 0,
              by_poles = 0;
  std::set<FaceId> refused_facets;

  void begin(const SurfaceMesh& t) {
    t_ = &t;
    poles_.assign(t.poles.begin(), t.poles.end());
  }
  double worst(FaceId f) const {
    const Triangle& v = t_->mesh.faces[f].v;
    const auto at = [&](std::size_t i) { return t_->mesh.points[v[i]]; };
    const paper::Options& o = program_.options;
    const double shape =
        violation(at(0), at(1), at(2), t_->duals[f].x, o.epsilon1, o.lambda, program_.report.r_min);
    const double r = distance(at(0), circumcenter(at(0), at(1), at(2)));
    const double h_sigma = (poles_[v[0]] + poles_[v[1]] + poles_[v[2]]) / 3;
    return r <= program_.report.r_min ? 0 : std::max(shape, r / h_sigma / o.epsilon2);
  }
  // x of the facet by a search along all of its dual line within r.
  std::optional<Vec3> nearest_on_dual_line(FaceId f) const {
    const Triangle& v = t_->mesh.faces[f].v;
    const auto at = [&](std::size_t i) { return t_->mesh.points[v[i]]; };
    const FacetLine line = facet_line(at(0), at(1), at(2));
    std::vector<Hit> hits;
    SearchCounters counters;
    surface_.intersect(
        {line.center - line.radius * line.normal, line.center + line.radius * line.normal}, hits,
        counters);
    if (hits.empty()) return std::nullopt;
    return std::ranges::min_element(hits, {},
                                    [&](const Hit& x) { return distance(x.point, line.center); })
        ->point;
  }

  void asks(paper::Reason, FaceId f, double value) override {
    ++asked;
    asked_ = f;
    CHECK(t_->duals[f].on_sigma);
    CHECK(value > 1);
    CHECK(value == doctest::Approx(worst(f)));
    find_encroached(f);
  }
  void encroaches(const Vec3& p, std::span<const FaceId> e) override {
    CHECK(p == t_->duals[asked_].x);
    CHECK(std::set<FaceId>(e.begin(), e.end()) == e_);
    CHECK(e.size() == e_.size());
    rim_ = rim_of(t_->mesh, e_);
    is_plain_disk_ = is_plain_disk(t_->mesh, e_);
  }
  void cone_added(VertexId v, std::span<const FaceId> d) override {
    ++cones;
    larger += e_.size() > 4;
    CHECK(is_plain_disk_);
    CHECK(!is_beside_box(t_->mesh.points[v]));
    // D is in place: nothing but the new vertex itself may be near.
    CHECK(!is_beside_vertex(t_->mesh.points[v]));
    std::map<Side, FaceId> left = rim_;
    const std::set<FaceId> cone(d.begin(), d.end());
    CHECK(cone.size() == rim_.size());
    CHECK(std::ranges::includes(cone, e_));
    double sum = 0;
    for (const FaceId f : d) {
      const Face& face = t_->mesh.faces[f];
      const std::size_t apex = static_cast<std::size_t>(corner_index(face, v));
      CHECK(face.v[apex] == v);
      const Side side{face.v[(apex + 1) % 3], face.v[(apex + 2) % 3]};
      REQUIRE(left.contains(side));
      CHECK(face.n[apex] == left[side]);
      if (left[side] != kNoId) {
        CHECK(std::ranges::count(t_->mesh.faces[left[side]].n, f) == 1);
      }
      left.erase(side);
      for (const std::size_t i : {(apex + 1) % 3, (apex + 2) % 3}) {
        CHECK(cone.contains(face.n[i]));
        CHECK(has_corner(t_->mesh.faces[face.n[i]].v, face.v[3 - apex - i]));
      }
      const std::optional<Vec3> x = nearest_on_dual_line(f);
      CHECK(t_->duals[f].on_sigma == x.has_value());
      if (x) CHECK(distance(*x, t_->duals[f].x) < 1e-6);
      sum += poles_[side.first];
      refused_facets.erase(f);
    }
    CHECK(left.empty());
    poles_.push_back(sum / static_cast<double>(rim_.size()));
    CHECK(t_->poles[v] == doctest::Approx(poles_.back()));
  }
  void refused(Refusal why) override {
    if (why == Refusal::not_a_disk) {
      CHECK(!is_plain_disk_);
    } else if (why == Refusal::vertex_there) {
      CHECK(is_beside_vertex(t_->duals[asked_].x));
    } else {
      CHECK(why == Refusal::at_curve);
      CHECK(is_beside_box(t_->duals[asked_].x));
    }
    ++(why == Refusal::not_a_disk ? not_a_disk : why == Refusal::at_curve ? at_curve : near);
    refused_facets.insert(asked_);
  }

 private:
  // Sets e_ to the facets whose ball holds p, x of sigma, connected with sigma.
  void find_encroached(FaceId sigma) {
    const Vec3& p = t_->duals[sigma].x;
    std::set<FaceId> all;
    for (FaceId f = 0; f < t_->mesh.faces.size(); ++f) {
      const Vec3& x = t_->duals[f].x;
      const double r = distance(x, t_->mesh.points[t_->mesh.faces[f].v[0]]);
      if (distance(x, p) < r * (1 - 1e-9)) all.insert(f);
    }
    e_ = {sigma};
    for (bool grows = true; grows;) {
      grows = false;
      for (const FaceId f : std::set(e_)) {
        for (const FaceId g : t_->mesh.faces[f].n) {
          grows |= g != kNoId && all.contains(g) && e_.insert(g).second;
        }
      }
    }
  }
  // True if p is in the diametral ball of a side of E on the box.
  // A vertex of E, or of a facet beside it, is nearer than r_min / 4.
  bool is_beside_vertex(const Vec3& p) const {
    const auto is_near = [&](VertexId v) {
      return distance(p, t_->mesh.points[v]) < 0.25 * program_.report.r_min;
    };
    return std::ranges::any_of(rim_, [&](const auto& side_and_outside) {
      const auto& [side, outside] = side_and_outside;
      return is_near(side.first) ||
             (outside != kNoId && std::ranges::any_of(t_->mesh.faces[outside].v, is_near));
    });
  }
  bool is_beside_box(const Vec3& p) const {
    return std::ranges::any_of(rim_, [&](const auto& entry) {
      const Vec3 &a = t_->mesh.points[entry.first.first], &b = t_->mesh.points[entry.first.second];
      return entry.second == kNoId && distance(p, 0.5 * (a + b)) < 0.5 * distance(a, b);
    });
  }

  const Program& program_;
  Isosurface surface_;
  const SurfaceMesh* t_ = nullptr;
  std::vector<double> poles_;
  FaceId asked_ = 0;
  std::set<FaceId> e_;
  std::map<Side, FaceId> rim_;
  bool is_plain_disk_ = false;
};

// T_S of a field after Recover.
struct Begun {
  Begun(const Field& field, const paper::Options& options) : program(field, options) {
    program.recovery.recover();
    poles = paper::compute_poles(program.del().del(), program.sigma);
    t = paper::build_tri_mesh(program.del(), poles);
  }
  Program program;
  std::vector<double> poles;
  SurfaceMesh t;
};

}  // namespace

TEST_CASE("BuildTriMesh hands over Del S|Sigma, facing g < kappa") {
  for (const char* name : {"torus", "gyroid"}) {
    CAPTURE(std::string(name));
    const Begun begun(builtin(name, 16), few_vertices());
    const TriMesh& mesh = begun.t.mesh;
    CHECK(check_mesh(mesh) == "");
    const Triangulation& t = begun.program.del().del();
    std::map<std::array<double, 3>, SiteId> sites;
    const auto key = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
    for (SiteId q = 1; q < t.vertex_capacity(); ++q) sites[key(t.point(q))] = q;
    FacetHits expected = stored_hits(begun.program.del());
    CHECK(expected.size() == mesh.faces.size());
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      CHECK(begun.t.poles[v] == begun.poles[sites.at(key(mesh.points[v]))]);
    }
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      const auto at = [&](std::size_t i) { return mesh.points[mesh.faces[f].v[i]]; };
      SiteTriangle corners{sites.at(key(at(0))), sites.at(key(at(1))), sites.at(key(at(2)))};
      std::ranges::sort(corners);
      REQUIRE(expected.contains(corners));
      CHECK(begun.t.duals[f].on_sigma);
      CHECK(begun.t.duals[f].x == expected[corners][0]);
      expected.erase(corners);
      const Vec3 normal = area_normal(at(0), at(1), at(2));
      const Vec3 gradient = begun.program.volume.gradient(begun.t.duals[f].x);
      CHECK(dot(normal, gradient) < 0);
    }
    CHECK(paper::build_tri_mesh(begun.program.del(), {}).poles.size() == 0);
  }
}

TEST_CASE("of several hits a facet keeps that nearest to its circumcenter") {
  std::size_t met_twice = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Program program(noise(seed, 9), few_vertices());
    const FacetHits all = stored_hits(program.del());
    const SurfaceMesh t = paper::build_tri_mesh(program.del(), {});
    met_twice += count_met_twice(all);
    std::multiset<double> kept, nearest;
    for (FaceId f = 0; f < t.mesh.faces.size(); ++f) {
      const auto at = [&](std::size_t i) { return t.mesh.points[t.mesh.faces[f].v[i]]; };
      kept.insert(distance(t.duals[f].x, circumcenter(at(0), at(1), at(2))));
    }
    for (const auto& facet : all) {
      const auto at = [&](std::size_t i) { return program.del().del().point(facet.first[i]); };
      const Vec3 center = circumcenter(at(0), at(1), at(2));
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& x : facet.second) least = std::min(least, distance(x, center));
      nearest.insert(least);
    }
    CHECK(std::ranges::equal(kept, nearest,
                             [](double a, double b) { return std::fabs(a - b) < 1e-9; }));
  }
  CHECK(met_twice > 10);
}

TEST_CASE("a facet of several hits is turned as most of its neighbors, which have one") {
  std::size_t checked = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    paper::Options options = few_vertices();
    options.lines = 10;
    const Program program(noise(seed, 6), options);
    const TriMesh mesh = paper::build_tri_mesh(program.del(), {}).mesh;
    std::vector<std::uint8_t> several;  // by facet
    for_each_finite_facet(program.del().del(), [&](Facet f) {
      const std::size_t hits = program.del().hits(f).size();
      if (hits > 0) several.push_back(hits > 1);
    });
    REQUIRE(several.size() == mesh.faces.size());
    std::vector<int> against(several.size(), 0), beside_several(several.size(), 0);
    for_each_edge(edge_uses(mesh.points.size(), mesh.triangles()),
                  [&](std::span<const EdgeUse> edge) {
                    if (edge.size() != 2) return true;
                    for (std::size_t n = 0; n < 2; ++n) {
                      against[edge[n].triangle] += edge[0].forward == edge[1].forward;
                      beside_several[edge[n].triangle] += several[edge[1 - n].triangle];
                    }
                    return true;
                  });
    for (std::size_t f = 0; f < several.size(); ++f) {
      if (several[f] == 0 || beside_several[f] > 0) continue;
      CHECK(against[f] < 2);
      ++checked;
    }
  }
  CHECK(checked > 5);
}

TEST_CASE("RefineGeom: E by a walk, D the cone, until no facet violates a criterion") {
  struct Case {
    std::string name;
    Field field;
    double r_min, epsilon;
  };
  const Case cases[] = {{"torus", builtin("torus", 32), 0.001, 0.2},
                        {"gyroid", builtin("gyroid", 16), 0.05, 0.2},
                        {"noise", noise(4, 9), 0.03, 0.2},
                        {"noise, switched early", noise(3, 9), 0.03, 1e9},
                        {"noise, again", noise(4, 9), 0.03, 1e9}};
  std::size_t asked = 0, at_curve = 0, not_a_disk = 0, near = 0, larger = 0;
  for (const Case& of : cases) {
    CAPTURE(of.name);
    paper::Options options = few_vertices();
    options.r_min = of.r_min;
    options.epsilon = of.epsilon;
    Begun begun(of.field, options);
    RefineWatch watch(begun.program);
    watch.begin(begun.t);
    begun.program.options.observer = &watch;
    paper::Report& report = begun.program.report;
    const std::size_t before = begun.t.mesh.points.size(), in_recover = report.curve_refusals;
    refine_geom(begun.t, begun.program.sigma, begun.program.options, report);
    CHECK(check_mesh(begun.t.mesh) == "");
    CHECK(report.insertions_refine == watch.cones);
    CHECK(begun.t.mesh.points.size() == before + watch.cones);
    CHECK(watch.asked == watch.cones + watch.at_curve + watch.not_a_disk + watch.near);
    CHECK(report.not_a_disk == watch.not_a_disk);
    CHECK(report.too_near == watch.near);
    CHECK(report.curve_refusals == in_recover + watch.at_curve);
    std::size_t unrefined = 0, without_point = 0;
    for (FaceId f = 0; f < begun.t.mesh.faces.size(); ++f) {
      const bool is_violating = watch.worst(f) > 1;
      unrefined += is_violating;
      without_point += !begun.t.duals[f].on_sigma;
      if (is_violating && begun.t.duals[f].on_sigma) CHECK(watch.refused_facets.contains(f));
    }
    CHECK(report.facets_unrefined == unrefined);
    CHECK(report.facets_without_point == without_point);
    asked += watch.asked;
    at_curve += watch.at_curve;
    not_a_disk += watch.not_a_disk;
    near += watch.near;
    larger += watch.larger;
  }
  CHECK(asked > 1000);
  CHECK(larger > 100);
  CHECK(at_curve > 0);
  CHECK(not_a_disk > 0);
  CHECK(near > 0);
}
