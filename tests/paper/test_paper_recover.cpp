// SPDX-License-Identifier: MIT
// Figure 5, step by step: what each routine asks for is seen from outside, and what it leaves.
#include "paper/recover.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

#include "paper/poles.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::BoundaryCurves;
using paper::Reason;
using paper::Refusal;
using paper::RestrictedDelaunay;

namespace {

// The edges of the boundary curves, by their ends. Splits are followed.
struct Curves {
  struct Edge {
    Vec3 a, b;
    BoxFace face;
  };
  std::vector<Edge> edges;

  explicit Curves(const BoundaryCurves& curves) {
    for (const auto& [a, b, face] : curves.edges) {
      edges.push_back({curves.points[a], curves.points[b], face});
    }
  }
  // Returns the longest edge whose diametral ball holds p; the end if there is none.
  std::vector<Edge>::iterator encroached(const Vec3& p) {
    auto longest = edges.end();
    for (auto e = edges.begin(); e != edges.end(); ++e) {
      const bool holds = distance(p, 0.5 * (e->a + e->b)) < 0.5 * distance(e->a, e->b) - 1e-12;
      if (holds &&
          (longest == edges.end() || distance(e->a, e->b) > distance(longest->a, longest->b))) {
        longest = e;
      }
    }
    return longest;
  }
  std::vector<Vec3> neighbors(const Vec3& p) const {
    std::vector<Vec3> all;
    for (const Edge& e : edges) {
      if (e.a == p) all.push_back(e.b);
      if (e.b == p) all.push_back(e.a);
    }
    return all;
  }
};

// Disk(): a disk, or on the curves a half disk from one neighbor there to the other.
bool is_good(SiteId q, const std::vector<Triangle>& d_q, const Triangulation& t,
             const Curves& curves) {
  const Star star = classify_star(VertexId(q.number()), d_q);
  const std::vector<Vec3> ends = curves.neighbors(t.point(q));
  if (ends.empty()) return star == Star::disk;
  return star == Star::half_disk && std::ranges::all_of(ends, [&](const Vec3& end) {
           return std::ranges::count_if(d_q, [&](const Triangle& v) {
                    return std::ranges::any_of(
                        v, [&](VertexId w) { return t.point(SiteId(w.number())) == end; });
                  }) == 1;
         });
}

enum class Step { multi_intersect, extract_manifold, approximate_geom };

Step step_of(Reason reason) {
  switch (reason) {
    case Reason::several_hits:
      return Step::multi_intersect;
    case Reason::not_a_disk:
    case Reason::not_a_half_disk:
    case Reason::facet_cycle:
      return Step::extract_manifold;
    default:
      return Step::approximate_geom;
  }
}

// Holds every question and every insertion against all facets and all edges of the curves.
class Watch : public paper::Observer {
 public:
  explicit Watch(const Field& field)
      : volume_(field.volume),
        kappa_(geometric_isovalue(volume_.type(), field.isovalue)),
        curves(paper::marching_squares(volume_, kappa_)) {}

  // Of the run that is to follow.
  void begin(Program& program, double epsilon) {
    program_ = &program;
    epsilon_ = epsilon;
  }

  std::size_t asked = 0, split = 0, at_curve = 0, vertex_there = 0, half_disks_asked = 0,
              empty_asked = 0;
  std::vector<Step> steps;      // without repetitions
  std::set<SiteId> refused_at;  // vertices whose last question was refused

  void asks(Reason reason, Facet sigma, SiteId q, double value, const Vec3& x) override {
    ++asked;
    const Step step = step_of(reason);
    if (steps.empty() || steps.back() != step) steps.push_back(step);
    const Triangulation& t = program_->del().del();
    const std::span<const Hit> hits = program_->del().hits(sigma);
    const SiteTriangle v = facet_vertices(t, sigma);
    const auto far = [&](const Vec3& from, const Hit& hit) { return distance(from, hit.point); };
    const Vec3& a = t.point(v[0]);
    double furthest = 0, nearest = std::numeric_limits<double>::infinity();
    for (const Hit& hit : hits) {
      furthest = std::max(furthest, far(a, hit));
      nearest = std::min(nearest, far(a, hit));
    }
    if (step == Step::multi_intersect) {
      CHECK(value > 1);
      CHECK(value == hits.size());
      CHECK(distance(x, a) == furthest);
    } else if (step == Step::approximate_geom) {
      CHECK(distance(x, a) == nearest);
      const double worst = violation(a, t.point(v[1]), t.point(v[2]), x, epsilon_,
                                     program_->options.lambda, program_->report.r_min);
      CHECK(worst > 1);
      CHECK(value == doctest::Approx(worst));
    } else {
      std::vector<Triangle> d_q;
      double from_q = 0;
      for_each_finite_facet(t, [&](Facet f) {
        const SiteTriangle corners = facet_vertices(t, f);
        if (std::ranges::count(corners, q) == 0 || program_->del().hits(f).empty()) return;
        d_q.push_back(as_mesh_triangle(corners));
        for (const Hit& hit : program_->del().hits(f)) {
          from_q = std::max(from_q, far(t.point(q), hit));
        }
      });
      CHECK(!is_good(q, d_q, t, curves));
      refused_at.erase(q);
      CHECK(value == d_q.size());
      if (d_q.empty()) {
        ++empty_asked;
        CHECK(reason == Reason::not_a_disk);
        CHECK(std::fabs(volume_.value(x) - kappa_) < 1e-6);
      } else {
        CHECK((reason == Reason::not_a_half_disk) == !curves.neighbors(t.point(q)).empty());
        CHECK(distance(x, t.point(q)) == from_q);
      }
      half_disks_asked += classify_star(VertexId(q.number()), d_q) == Star::half_disk;
    }
    x_ = x;
    q_ = q;
  }
  void refused(Refusal why) override {
    is_split_ = why == Refusal::split;
    split += is_split_;
    at_curve += why == Refusal::at_curve;
    vertex_there += why == Refusal::vertex_there;
    if (!is_split_) refused_at.insert(q_);
    if (why == Refusal::vertex_there) return;
    const auto edge = curves.encroached(x_);
    REQUIRE(edge != curves.edges.end());
    const double length = distance(edge->a, edge->b);
    if (length < 0.02 * volume_.voxel()) CHECK(why == Refusal::at_curve);
  }
  void insertion_begins(const Vec3& p, const ConflictZone&) override {
    if (!is_split_) {
      CHECK(p == x_);
      CHECK(curves.encroached(p) == curves.edges.end());
      return;
    }
    is_split_ = false;
    const auto edge = curves.encroached(x_);
    const auto [a, b, face] = *edge;
    CHECK((box_faces_at(p, volume_.box()) >> face & 1) == 1);
    CHECK(std::fabs(volume_.value(p) - kappa_) < 1e-6);
    CHECK(distance(p, 0.5 * (a + b)) <= 0.5 * distance(a, b));
    *edge = {a, p, face};
    curves.edges.push_back({p, b, face});
  }

 private:
  Volume volume_;
  double kappa_, epsilon_ = 0;
  Program* program_ = nullptr;
  Vec3 x_;
  SiteId q_ = kNoId;
  bool is_split_ = false;

 public:
  Curves curves;
};

// A run that is watched.
struct Watched {
  Watched(const Field& field, paper::Options options)
      : watch(field), program(field, (options.observer = &watch, options)) {
    watch.begin(program, options.epsilon);
  }
  // Vertices that have facets, but neither a disk nor a half disk.
  std::set<SiteId> bad() const {
    std::set<SiteId> all;
    for (const auto& [q, d_q] : stars(stored_hits(program.del()))) {
      if (!is_good(q, d_q, program.del().del(), watch.curves)) all.insert(q);
    }
    return all;
  }
  std::size_t count_refused() const { return watch.at_curve + watch.vertex_there; }

  Watch watch;
  Program program;
};

paper::Options with_lines(std::size_t lines, std::uint64_t seed) {
  paper::Options options = few_vertices(6000);
  options.lines = lines;
  options.seed = seed;
  return options;
}

}  // namespace

TEST_CASE("MultiIntersect leaves no Voronoi edge that meets Sigma twice") {
  std::size_t before = 0, splits = 0;
  const auto check = [&](const Field& field, const paper::Options& options) {
    Watched run(field, options);
    before += count_met_twice(stored_hits(run.program.del()));
    run.program.recovery.multi_intersect();
    CHECK(count_met_twice(stored_hits(run.program.del())) <= run.count_refused());
    splits += run.watch.split;
    run.program.recovery.count_left();
    CHECK(run.program.report.facets_left == count_met_twice(stored_hits(run.program.del())));
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    check(builtin("linked_tori", 24), with_lines(10, seed));
  }
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    check(noise(seed, 9), with_lines(5, seed));
  }
  CHECK(before > 100);
  CHECK(splits > 20);
}

TEST_CASE("ExtractManifold leaves disks, and half disks on the boundary curves alone") {
  std::size_t half_disks = 0, splits = 0;
  const auto check = [&](const Field& field, const paper::Options& options) {
    Watched run(field, options);
    run.program.recovery.multi_intersect();
    const std::size_t asked = run.watch.asked;
    CHECK(!run.bad().empty());
    run.program.recovery.extract_manifold();
    CHECK(run.watch.asked > asked);
    CHECK(std::ranges::includes(run.watch.refused_at, run.bad()));
    half_disks += run.watch.half_disks_asked;
    splits += run.watch.split;
    run.program.recovery.count_left();
    CHECK(run.program.report.vertices_left == run.bad().size());
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    check(builtin("linked_tori", 24), with_lines(10, seed));
    check(builtin("gyroid", 16), with_lines(10, seed));
    check(noise(seed, 9), with_lines(5, seed));
  }
  // An edge is split far from a vertex, whose facets stay as they are: it must be tested again.
  check(noise(30, 7), with_lines(5, 30));
  CHECK(half_disks > 10);
  CHECK(splits > 50);
}

TEST_CASE("ApproximateGeom leaves no facet above r_min that violates a criterion") {
  struct Limits {
    double epsilon, lambda, r_min;
  };
  constexpr double kNone = 1e9;
  std::vector<std::size_t> vertices;
  for (const auto& [epsilon, lambda, r_min] :
       {Limits{0.2, 2, 0.001}, Limits{0.1, 2, 0.001}, Limits{kNone, 1.2, 0.001},
        Limits{kNone, kNone, 0.001}, Limits{0.05, 2, 0.08}}) {
    paper::Options options = few_vertices();
    options.lambda = lambda;
    options.r_min = r_min;
    options.epsilon = epsilon;
    Watched run(builtin("torus", 24), options);
    Program& program = run.program;
    program.recovery.multi_intersect();
    program.recovery.extract_manifold();
    const std::size_t before = program.del().del().vertex_capacity();
    program.recovery.approximate_geom(epsilon);
    vertices.push_back(program.del().del().vertex_capacity() - before);
    CHECK(run.count_refused() == 0);
    for (const auto& facet : stored_hits(program.del())) {
      const auto at = [&](std::size_t i) { return program.del().del().point(facet.first[i]); };
      const Vec3 x = *std::ranges::min_element(
          facet.second, {}, [&](const Vec3& hit) { return distance(hit, at(0)); });
      CHECK(violation(at(0), at(1), at(2), x, epsilon, lambda, program.report.r_min) <= 1);
    }
  }
  CHECK(vertices[0] > 50);
  CHECK(vertices[1] > 2 * vertices[0]);
  CHECK(vertices[2] > 20);
  CHECK(vertices[3] == 0);
  // Facets up to r_min are left as they are.
  CHECK(vertices[4] > 0);
  CHECK(vertices[4] < vertices[1]);
}

TEST_CASE("the last ExtractManifold mends what ApproximateGeom left") {
  int needed = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Watched run(noise(seed, 6), with_lines(10, seed));
    run.program.recovery.recover();
    needed += run.watch.steps.back() == Step::extract_manifold &&
              std::ranges::count(run.watch.steps, Step::approximate_geom) == 1;
    CHECK(std::ranges::includes(run.watch.refused_at, run.bad()));
  }
  CHECK(needed > 0);
}

TEST_CASE(
    "ApproximateGeom asks for a point of a facet that is too large for its poles, if told these") {
  // Holds the worst violation against pole heights that are all alike.
  struct AllAlike : paper::Observer {
    const RestrictedDelaunay* del = nullptr;
    std::size_t by_poles = 0;
    double r_min = 0, height = 0;

    void asks(Reason reason, Facet sigma, SiteId, double value, const Vec3& x) override {
      const SiteTriangle v = facet_vertices(del->del(), sigma);
      const auto at = [&](std::size_t i) { return del->del().point(v[i]); };
      const double shape = violation(at(0), at(1), at(2), x, 0.1, 2, r_min);
      const double r = distance(circumcenter(at(0), at(1), at(2)), at(0));
      const double by_height = r / height / 0.2;
      CHECK(value == doctest::Approx(std::max(shape, by_height)));
      CHECK((reason == Reason::r_over_pole) == (by_height > shape));
      by_poles += reason == Reason::r_over_pole;
    }
  } poles;
  Program program(builtin("torus", 24), few_vertices());
  program.recovery.recover();
  poles.del = &program.del();
  poles.r_min = program.report.r_min;
  program.options.observer = &poles;
  poles.height = 4 * program.volume.voxel();
  program.recovery.approximate_geom(0.1, [&](const SiteTriangle&) { return poles.height; });
  CHECK(poles.by_poles > 100);
}
