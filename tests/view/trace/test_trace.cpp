// SPDX-License-Identifier: MIT
// What a trace tells, against what came out: its facets replayed are the mesh, its zones are in
// conflict by exact predicates, and the run is the one that it would have been without.
#include "view/trace/recorder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "base/box3.h"
#include "deliso/mesh_isosurface.h"
#include "exact/predicates.h"
#include "fields.h"
#include "mesh/meshes.h"
#include "mesh/star.h"
#include "paper/deliso.h"
#include "recover/certified.h"
#include "refine/refinement.h"
#include "view/trace/record_paper.h"
#include "view/trace/trace_names.h"

using namespace deliso;

namespace {

constexpr std::size_t kNoLimit = 1'000'000;

struct Traced {
  Trace trace{kNoLimit, false};
  TriMesh mesh;
  Report report;            // of the exact program
  paper::Report published;  // or of the published one
};

Traced traced(const Volume& volume, double isovalue, Options options,
              std::size_t limit = kNoLimit) {
  Traced out;
  out.trace = Trace(limit, false);
  TraceRecorder recorder(out.trace);
  options.observer = &recorder;
  out.mesh = mesh_isosurface(volume, isovalue, options, out.report);
  return out;
}

Traced traced(const Scene& scene, const Options& options, std::size_t limit = kNoLimit) {
  return traced(scene.volume, scene.surface.kappa(), options, limit);
}

TriMesh run_published(const Scene& scene, const paper::Options& options, bool certified,
                      paper::Report& report) {
  const double isovalue = scene.surface.kappa();
  return certified ? certified_deliso(scene.volume, isovalue, options, report)
                   : paper::deliso(scene.volume, isovalue, options, report);
}

Traced traced(const Scene& scene, paper::Options options, std::size_t limit = kNoLimit,
              bool certified = false) {
  Traced out;
  out.trace = Trace(limit, false);
  PaperRecorder recorder(out.trace);
  options.observer = &recorder;
  out.mesh = run_published(scene, options, certified, out.published);
  return out;
}

// Calls look(options) with both programs' options.
template <class Look>
void for_both_programs(Look&& look) {
  look(Options{});
  look(paper::Options{.r_min = 0.02});
}

// The items of one event.
template <std::size_t N, class T>
std::vector<std::array<T, N>> items(const TraceList<T>& list, std::size_t event) {
  std::vector<std::array<T, N>> out;
  for (std::size_t n = list.begin[event]; n < list.begin[event + 1]; ++n) {
    std::array<T, N> item;
    std::copy_n(list.values.begin() + static_cast<std::ptrdiff_t>(N * n), N, item.begin());
    out.push_back(item);
  }
  return out;
}

std::vector<Triangle> triangles_of(const TraceList<std::uint32_t>& list, std::size_t event) {
  std::vector<Triangle> out;
  for (const auto& t : items<3>(list, event)) out.push_back(triangle_of(t[0], t[1], t[2]));
  return out;
}

Triangle rotated(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Triangle mirrored(const Triangle& t) {
  return {t[1], t[0], t[2]};
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

using Complex = std::map<Triangle, int>;

// Does what event e says; every facet removed must be there.
void replay(const Trace& trace, std::size_t e, Complex& complex) {
  for (const Triangle& t : triangles_of(trace.arrays().removed, e)) {
    const auto at = complex.find(rotated(t));
    REQUIRE(at != complex.end());
    if (--at->second == 0) complex.erase(at);
  }
  for (const Triangle& t : triangles_of(trace.arrays().added, e)) {
    for (const VertexId v : t) REQUIRE(v < trace.arrays().points.size() / 3);
    ++complex[rotated(t)];
  }
}

Routine routine_of(const Trace& trace, std::size_t e) {
  return static_cast<Routine>(std::min(trace.arrays().routine[e], trace_code(Routine::count_)));
}

Reason reason_of(const Trace& trace, std::size_t e) {
  return static_cast<Reason>(std::min(trace.arrays().reason[e], trace_code(Reason::count_)));
}

bool is_done(const Trace& trace, std::size_t e) {
  return trace.arrays().outcome[e] <= trace_code(TraceOutcome::split);
}

using Corners = std::array<std::array<double, 3>, 3>;

Corners corners(const std::array<Vec3, 3>& p) {
  Corners c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = {p[i].x, p[i].y, p[i].z};
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return c;
}

// Facets by where their corners are: the mesh's, and a complex's.
std::multiset<Corners> facets_of(const TriMesh& mesh) {
  std::multiset<Corners> out;
  for (const Face& f : mesh.faces) {
    out.insert(corners({mesh.points[f.v[0]], mesh.points[f.v[1]], mesh.points[f.v[2]]}));
  }
  return out;
}

std::multiset<Corners> facets_of(const Trace& trace, const Complex& complex) {
  std::multiset<Corners> out;
  for (const auto& [t, count] : complex) {
    REQUIRE(count == 1);
    out.insert(corners({trace.point(t[0]), trace.point(t[1]), trace.point(t[2])}));
  }
  return out;
}

// An event that puts a mesh in the place of Stage 1's facets.
bool is_switch(Routine routine) {
  return routine == Routine::build_tri_mesh || routine == Routine::coarsen;
}

// T2, and what the two complexes at the switch have to do with each other: BuildTriMesh's are the
// same.
void check_replay(const Traced& run) {
  const Trace& trace = run.trace;
  REQUIRE(!trace.truncated());
  REQUIRE(trace.size() == trace.events_seen());
  Complex complex;
  int switches = 0;
  for (std::size_t e = 0; e < trace.size(); ++e) {
    if (const Routine routine = routine_of(trace, e); is_switch(routine)) {
      ++switches;
      std::multiset<Triangle> before, after;
      for (const auto& [t, count] : complex) before.insert(sorted(t));
      replay(trace, e, complex);
      for (const auto& [t, count] : complex) after.insert(sorted(t));
      if (routine == Routine::build_tri_mesh) CHECK(before == after);
      CHECK(triangles_of(trace.arrays().removed, e).size() == before.size());
    } else {
      replay(trace, e, complex);
    }
    if (!is_done(trace, e)) {
      CHECK(triangles_of(trace.arrays().removed, e).empty());
      CHECK(triangles_of(trace.arrays().added, e).empty());
      CHECK(trace.arrays().vertex[e] == kNoId);
    }
  }
  CHECK(switches == 1);
  CHECK(facets_of(trace, complex) == facets_of(run.mesh));
  std::vector<Triangle> left;
  for (const auto& [t, count] : complex) left.push_back(t);
  CHECK(trace.complex() == left);
}

// Every cell of every zone holds the point in its circumsphere. Returns how many there were.
std::size_t check_zones(const Trace& trace) {
  std::size_t cells = 0;
  for (std::size_t e = 1; e < trace.size(); ++e) {
    const auto zone = items<4>(trace.arrays().zone, e);
    const std::uint32_t v = trace.arrays().vertex[e];
    const bool is_stage1 = routine_of(trace, e) < Routine::build_tri_mesh;
    CHECK((is_stage1 || zone.empty()));
    if (v == kNoId || !is_stage1) continue;
    CHECK(trace.arrays().place[3 * e] == static_cast<float>(trace.point(v).x));
    for (const auto& c : zone) {
      const Vec3 &p = trace.point(c[0]), &q = trace.point(c[1]), &r = trace.point(c[2]),
                 &s = trace.point(c[3]);
      REQUIRE(orient3d(p, q, r, s) > 0);
      CHECK(insphere(p, q, r, s, trace.point(v)) > 0);
    }
    cells += zone.size();
  }
  return cells;
}

// The largest distance of all facets above r_min. x(f): the surface point of f, or none.
template <class SurfacePoint>
float largest_distance(const TriMesh& mesh, double r_min, SurfacePoint&& x) {
  double h = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    const Triangle& v = mesh.faces[f].v;
    const std::optional<Vec3> at = x(f);
    const FacetShape shape =
        measure(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], at.value_or(Vec3{}));
    if (shape.r > r_min) h = std::max(h, at ? shape.h : shape.r);
  }
  return static_cast<float>(h);
}

// The trace has these from the switch on, and none before.
void check_worst(const Trace& trace, const std::vector<float>& worst) {
  const std::vector<float>& told = trace.arrays().worst;
  REQUIRE(told.size() > worst.size());
  const auto at_switch = told.end() - static_cast<std::ptrdiff_t>(worst.size());
  CHECK(std::all_of(told.begin(), at_switch, [](float h) { return std::isnan(h); }));
  CHECK(std::equal(worst.begin(), worst.end(), at_switch));
}

}  // namespace

TEST_CASE("facets replayed are the mesh, and zones are in conflict, in both programs") {
  for (const char* name : {"sphere", "torus", "fuel", "gyroid"}) {
    const Scene scene = builtin_scene(name, 24);
    for_both_programs([&](const auto& options) {
      CAPTURE(name);
      const Traced run = traced(scene, options);
      check_replay(run);
      const std::size_t cells = check_zones(run.trace);
      const std::size_t recovered = run.published.insertions_recover;
      if (recovered > 0) CHECK(cells > recovered);
      const auto inserted =
          std::count_if(run.trace.arrays().vertex.begin(), run.trace.arrays().vertex.end(),
                        [](std::uint32_t v) { return v != kNoId; });
      CHECK(static_cast<std::size_t>(inserted) >= recovered);
    });
  }
}

TEST_CASE(
    "the exact program begins with T, on the surface and of its topology, and coarsens it step by "
    "step") {
  for (const char* name : {"torus", "gyroid", "noise"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 16);
    const Traced run = traced(scene, Options{});
    const Trace& trace = run.trace;
    REQUIRE(trace.size() >= 2);
    CHECK(routine_of(trace, 0) == Routine::contour);
    Complex complex;
    replay(trace, 0, complex);
    CHECK(static_cast<float>(complex.size()) == trace.arrays().value[0]);
    std::set<VertexId> vertices;
    std::set<std::pair<VertexId, VertexId>> edges;
    for (const auto& [t, count] : complex) {
      for (std::size_t i = 0; i < 3; ++i) {
        vertices.insert(t[i]);
        edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
      }
    }
    const auto euler = static_cast<std::int64_t>(vertices.size()) -
                       static_cast<std::int64_t>(edges.size()) +
                       static_cast<std::int64_t>(complex.size());
    CHECK(euler == run.report.exact.euler);
    for (const VertexId v : vertices) {
      REQUIRE(std::abs(scene.volume.value(trace.point(v)) - scene.surface.kappa()) < 1e-6);
    }
    // A removal takes all facets at its vertex away, and puts none there.
    const auto facets_at = [](const std::vector<Triangle>& facets, VertexId v) {
      return std::ranges::count_if(facets, [&](const Triangle& t) { return has_corner(t, v); });
    };
    std::size_t removals = 0, e = 1;
    for (; routine_of(trace, e) != Routine::coarsen; ++e) {
      const auto removed = triangles_of(trace.arrays().removed, e);
      const auto added = triangles_of(trace.arrays().added, e);
      if (routine_of(trace, e) == Routine::contour) removals = 0;  // T is coarsened again
      if (routine_of(trace, e) == Routine::remove_vertices) {
        ++removals;
        const VertexId v(trace.arrays().caller[3 * e]);
        CHECK(facets_at(removed, v) == std::ssize(removed));
        CHECK(facets_at(added, v) == 0);
        CHECK(added.size() < removed.size());
      }
      if (routine_of(trace, e) == Routine::flip_edges) CHECK(added.size() == removed.size());
      replay(trace, e, complex);
    }
    CHECK(removals > vertices.size() / 5);
    CHECK(vertices.size() - removals == run.report.vertices_coarsened);
    const Complex before = complex;
    replay(trace, e, complex);
    CHECK(complex == before);
    Options stage1;
    stage1.stop_after_stage1 = true;
    CHECK(facets_of(trace, complex) == facets_of(traced(scene, stage1).mesh));
  }
}

TEST_CASE("the published program without Refine, or with facet cycles, ends with its mesh too") {
  check_replay(
      traced(wave_scene(1, 10), paper::Options{.r_min = 0.05, .stop_after_recover = true}));
  // A point of a facet cycle is on no Voronoi edge that is shown.
  std::size_t cycles = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Traced run =
        traced(builtin_scene(seed % 2 == 0 ? "noise" : "linked_tori", 16 + int(seed)),
               paper::Options{.r_min = 0.02, .lines = 9, .facet_cycles = true});
    check_replay(run);
    const TraceArrays& a = run.trace.arrays();
    for (std::size_t e = 0; e < run.trace.size(); ++e) {
      if (a.reason[e] != trace_code(PaperReason::facet_cycle)) continue;
      ++cycles;
      CHECK(a.hits.begin[e] == a.hits.begin[e + 1]);
      CHECK(a.routine[e] == trace_code(Routine::extract_manifold));
    }
  }
  CHECK(cycles > 0);
}

TEST_CASE("the worst distance of the mesh after every event, by brute force") {
  // Looks at all facets after each operation.
  struct AllFacets : TraceRecorder {
    using TraceRecorder::TraceRecorder;
    void mesh_handed_over(const SurfaceMesh& s) override {
      surface_mesh = &s;
      TraceRecorder::mesh_handed_over(s);
      worst.push_back(largest());
    }
    void operation_tried(const Question& question, Operation operation,
                         const Replacement& replacement, std::optional<Refusal> refusal) override {
      TraceRecorder::operation_tried(question, operation, replacement, refusal);
      worst.push_back(largest());
    }
    float largest() const {
      return largest_distance(surface_mesh->mesh, r_min, [&](FaceId f) {
        const Dual& dual = surface_mesh->duals[f];
        return dual.on_surface ? std::optional(dual.center) : std::nullopt;
      });
    }
    double r_min = 0;
    const SurfaceMesh* surface_mesh = nullptr;
    std::vector<float> worst;
  };
  for (const char* name : {"torus", "gyroid"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 16);
    Trace trace(kNoLimit, false);
    Report report;
    AllFacets recorder(trace);
    Options options;
    recorder.r_min = options.r_min.in(scene.volume);
    options.observer = &recorder;
    mesh_isosurface(scene.volume, scene.surface.kappa(), options, report);
    check_worst(trace, recorder.worst);
    CHECK(trace.arrays().worst.back() == static_cast<float>(report.largest_h));
  }
}

TEST_CASE("what calls for an insertion of the published program is what the trace says") {
  paper::Options options;
  options.lines = 8;
  options.epsilon1 = 0.15;
  options.epsilon2 = 0.5;
  std::map<Routine, int> asked;
  std::map<std::uint8_t, int> reasons, outcomes;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14);
    const Traced run = traced(scene, options);
    check_replay(run);
    const Trace& trace = run.trace;
    const TraceArrays& a = trace.arrays();
    CHECK(check_zones(trace) > 0);
    const Box3 box = scene.volume.box();
    const double near = 1e-5 * length(box.size());
    const auto is_near = [&](double x, double y) { return std::abs(x - y) < near; };
    Complex complex;
    for (std::size_t e = 0; e < trace.size(); replay(trace, e, complex), ++e) {
      CAPTURE(e);
      const Routine routine = routine_of(trace, e);
      ++asked[routine];
      ++outcomes[a.outcome[e]];
      if (routine == Routine::init_triangulation || routine == Routine::build_tri_mesh) continue;
      ++reasons[a.reason[e]];
      const auto hits = items<3>(a.hits, e);
      const auto star = triangles_of(a.star, e);
      const Triangle caller =
          triangle_of(a.caller[3 * e], a.caller[3 * e + 1], a.caller[3 * e + 2]);
      const Vec3 x{a.ball[4 * e], a.ball[4 * e + 1], a.ball[4 * e + 2]};
      const double radius = a.ball[4 * e + 3];
      if (routine != Routine::count_) {
        // Hits are on the Voronoi edge, and x is one of them. Unless an edge of the curves is split
        // in its place, it is the point.
        const Vec3 from{a.edge[6 * e], a.edge[6 * e + 1], a.edge[6 * e + 2]},
            to{a.edge[6 * e + 3], a.edge[6 * e + 4], a.edge[6 * e + 5]};
        double furthest = 0;
        bool has_x = false;
        for (const auto& h : hits) {
          const Vec3 hit{h[0], h[1], h[2]};
          CHECK(is_near(distance(from, hit) + distance(hit, to), distance(from, to)));
          furthest = std::max(furthest, distance(hit, trace.point(caller[0])));
          has_x = has_x || hit == x;
        }
        CHECK(has_x);
        CHECK(is_near(radius, distance(x, trace.point(caller[0]))));
        if (routine != Routine::approximate_geom) CHECK(is_near(radius, furthest));
      }
      if (a.outcome[e] != trace_code(TraceOutcome::split)) {
        const Vec3 place{a.place[3 * e], a.place[3 * e + 1], a.place[3 * e + 2]};
        CHECK(place == x);
      }
      if (routine == Routine::extract_manifold) {
        // The caller is q, and the star all of its facets.
        Complex at_q, told;
        for (const auto& facet : complex) {
          if (has_corner(facet.first, caller[0])) at_q.insert(facet);
        }
        for (const Triangle& t : star) ++told[rotated(t)];
        CHECK(told == at_q);
        CHECK(a.value[e] == static_cast<float>(star.size()));
        // Vertices on the curves are on the box, others inside.
        const Vec3& q = trace.point(caller[0]);
        bool on_curve = false;
        for (int axis = 0; axis < 3; ++axis) {
          on_curve = on_curve || q[axis] == box.lo[axis] || q[axis] == box.hi[axis];
        }
        CHECK(on_curve == (a.reason[e] == trace_code(PaperReason::no_half_disk)));
        CHECK(on_curve != (a.reason[e] == trace_code(PaperReason::no_disk)));
        if (!on_curve) CHECK(classify_star(caller[0], star) != Star::disk);
        continue;
      }
      for (const VertexId v : caller) CHECK(is_near(radius, distance(x, trace.point(v))));
      if (routine == Routine::multi_intersect) {
        CHECK(hits.size() >= 2);
        CHECK(a.value[e] == static_cast<float>(hits.size()));
        CHECK(a.reason[e] == trace_code(PaperReason::several_hits));
        continue;
      }
      // ApproximateGeom and RefineGeom: of a facet that is there, by its worst criterion.
      CHECK(a.value[e] > 1);
      const FacetShape shape =
          measure(trace.point(caller[0]), trace.point(caller[1]), trace.point(caller[2]), x);
      CHECK(shape.r > run.published.r_min);
      const double h_over_r =
          shape.h / shape.r / (routine == Routine::count_ ? options.epsilon1 : options.epsilon);
      const double r_over_l = shape.r / shape.l / options.lambda;
      const bool is_of_pole = a.reason[e] == trace_code(PaperReason::r_over_pole);
      CHECK((a.reason[e] == trace_code(Criterion::h_over_r) ||
             a.reason[e] == trace_code(Criterion::r_over_l) || is_of_pole));
      const double worst = a.reason[e] == trace_code(Criterion::h_over_r) ? h_over_r : r_over_l;
      // x is rounded.
      if (!is_of_pole) CHECK(a.value[e] == doctest::Approx(worst).epsilon(1e-3));
      CHECK(a.value[e] > std::max(h_over_r, r_over_l) - 1e-3);
      if (routine == Routine::approximate_geom) {
        CHECK(!is_of_pole);
        CHECK(complex.count(rotated(caller)) + complex.count(rotated(mirrored(caller))) == 1);
        continue;
      }
      // E has the caller, and D is the cone from the new vertex.
      CHECK(complex.count(rotated(caller)) == 1);
      const auto removed = triangles_of(a.removed, e), added = triangles_of(a.added, e);
      const auto& disk = is_done(trace, e) ? removed : star;
      CHECK(std::ranges::count(disk, rotated(caller), rotated) == 1);
      for (const Triangle& t : disk) CHECK(complex.count(rotated(t)) == 1);
      if (!is_done(trace, e)) continue;
      CHECK(added.size() == removed.size() + 2);
      for (const Triangle& t : added) CHECK(has_corner(t, VertexId(a.vertex[e])));
    }
  }
  for (const Routine routine :
       {Routine::init_triangulation, Routine::multi_intersect, Routine::extract_manifold,
        Routine::approximate_geom, Routine::build_tri_mesh, Routine::count_}) {
    CAPTURE(static_cast<int>(routine));
    CHECK(asked[routine] > 0);
  }
  for (std::uint8_t n = 0; n < static_cast<std::uint8_t>(PaperReason::facet_cycle); ++n) {
    CAPTURE(name_of(static_cast<PaperReason>(n)).name);
    CHECK(reasons[trace_code(static_cast<PaperReason>(n))] > 0);
  }
  for (const TraceOutcome outcome : {TraceOutcome::done, TraceOutcome::split,
                                     TraceOutcome::beside_a_curve, TraceOutcome::no_disk}) {
    CAPTURE(name_of(outcome).name);
    CHECK(outcomes[trace_code(outcome)] > 0);
  }
}

TEST_CASE("the worst distance of the published program's mesh after every event, by brute force") {
  // Looks at all facets after each event.
  struct AllFacets : PaperRecorder {
    using PaperRecorder::PaperRecorder;
    void mesh_ready(const paper::SurfaceMesh& t) override {
      mesh = &t;
      PaperRecorder::mesh_ready(t);
      worst.push_back(largest());
    }
    void cone_added(VertexId v, std::span<const FaceId> d) override {
      PaperRecorder::cone_added(v, d);
      worst.push_back(largest());
    }
    void refused(paper::Refusal refusal) override {
      PaperRecorder::refused(refusal);
      if (mesh) worst.push_back(largest());
    }
    float largest() const {
      return largest_distance(mesh->mesh, report.r_min, [&](FaceId f) {
        const paper::SurfaceMesh::Dual& dual = mesh->duals[f];
        return dual.on_sigma ? std::optional(dual.x) : std::nullopt;
      });
    }
    const paper::SurfaceMesh* mesh = nullptr;
    paper::Report report;
    std::vector<float> worst;
  };
  const Scene scene = wave_scene(4, 10);
  Trace trace(kNoLimit, false);
  AllFacets recorder(trace);
  paper::Options options{.r_min = 0.05, .observer = &recorder};
  paper::deliso(scene.volume, scene.surface.kappa(), options, recorder.report);
  CHECK(recorder.report.facets_without_point > 0);
  check_worst(trace, recorder.worst);
}

// Replays the labels, and adds the reasons of all events.
void check_labels(const Traced& run, std::set<std::uint8_t>& reasons) {
  const Trace& trace = run.trace;
  const TraceArrays& a = trace.arrays();
  std::vector<std::uint32_t> label = a.contour_label;
  REQUIRE(label.size() == a.contour_points.size() / 3);
  REQUIRE(!label.empty());
  std::set<std::uint32_t> sites(label.begin(), label.end());
  for (std::size_t e = 0; e < trace.size(); ++e) {
    reasons.insert(a.reason[e]);
    for (const auto& [v, site] : items<2>(a.relabel, e)) {
      CHECK(site == a.vertex[e]);
      label[v] = site;
      sites.insert(site);
    }
  }
  for (std::size_t v = 0; v < label.size(); ++v) {
    const Vec3 p{a.contour_points[3 * v], a.contour_points[3 * v + 1], a.contour_points[3 * v + 2]};
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t s : sites) nearest = std::min(nearest, distance(p, trace.point(s)));
    CHECK(distance(p, trace.point(label[v])) < nearest + 1e-5);
  }
}

TEST_CASE("labels replayed are those of the nearest site") {
  std::set<std::uint8_t> reasons;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14);
    const Traced run = traced(scene, paper::Options{.r_min = 0.02}, kNoLimit, true);
    check_replay(run);
    CHECK(check_zones(run.trace) > 0);
    check_labels(run, reasons);
    const TraceArrays& a = run.trace.arrays();
    CHECK(std::ranges::count_if(a.routine, [](std::uint8_t routine) {
            return routine == trace_code(Routine::certify) ||
                   routine == trace_code(Routine::approximate_geom);
          }) == static_cast<std::ptrdiff_t>(run.published.insertions_recover));
  }
  for (const PaperReason reason : {PaperReason::region, PaperReason::interface}) {
    CHECK(reasons.contains(trace_code(reason)));
  }
}

TEST_CASE("a limit keeps the first events, and counts the others") {
  const Scene scene = builtin_scene("fuel", 20);
  for_both_programs([&](const auto& options) {
    const Traced whole = traced(scene, options);
    for (const std::size_t limit :
         {std::size_t{1}, std::size_t{40}, whole.trace.size() - 1, whole.trace.size()}) {
      CAPTURE(limit);
      const Traced cut = traced(scene, options, limit);
      CHECK(test::same_mesh(cut.mesh, whole.mesh));
      REQUIRE(cut.trace.size() == limit);
      CHECK(cut.trace.events_seen() == whole.trace.size());
      CHECK(cut.trace.truncated() == (limit < whole.trace.size()));
      const TraceArrays &a = cut.trace.arrays(), &b = whole.trace.arrays();
      const auto begins = [](const auto& part, const auto& all) {
        return part.size() <= all.size() && std::equal(part.begin(), part.end(), all.begin());
      };
      CHECK(begins(a.routine, b.routine));
      CHECK(begins(a.caller, b.caller));
      CHECK(begins(a.removed.values, b.removed.values));
      CHECK(begins(a.added.begin, b.added.begin));
      CHECK(begins(a.added.values, b.added.values));
      CHECK(begins(a.zone.values, b.zone.values));
      CHECK(begins(a.points, b.points));
    }
  });
}

TEST_CASE("a traced run is the run without, and the same with any number of threads") {
  const Scene scene = builtin_scene("fuel", 32);
  Options options, undivided;
  options.threads = undivided.threads = 1;
  undivided.block_side = 0;  // as a trace has it
  Report report;
  const TriMesh plain = mesh_isosurface(scene.volume, scene.surface.kappa(), undivided, report);
  const Traced one = traced(scene, options);
  options.threads = 4;
  const Traced four = traced(scene, options);
  CHECK(test::same_mesh(one.mesh, plain));
  CHECK(test::same_mesh(four.mesh, plain));
  CHECK(one.report.counters == report.counters);
  CHECK(one.report.searches_refine.searches == report.searches_refine.searches);
  CHECK(one.trace.arrays().points == four.trace.arrays().points);
  CHECK(one.trace.arrays().added.values == four.trace.arrays().added.values);
  CHECK(one.trace.arrays().caller == four.trace.arrays().caller);
  CHECK(one.trace.arrays().value.size() == four.trace.arrays().value.size());
  CHECK(four.trace.arrays().micros == std::vector<std::uint32_t>(four.trace.size(), 0));
}

TEST_CASE(
    "a traced run of the published programs is the run without, also when the trace is full") {
  const Scene scene = wave_scene(5, 10);
  for (const bool certified : {false, true}) {
    const paper::Options options{.r_min = 0.05};
    paper::Report report;
    const TriMesh plain = run_published(scene, options, certified, report);
    for (const std::size_t limit : {std::size_t{1}, std::size_t{20}, kNoLimit}) {
      const Traced run = traced(scene, options, limit, certified);
      if (limit == kNoLimit) check_replay(run);
      CHECK(test::same_mesh(run.mesh, plain));
      CHECK(run.trace.size() == std::min(limit, run.trace.events_seen()));
      CHECK(run.published.searches_recover.searches == report.searches_recover.searches);
      CHECK(run.published.searches_refine.searches == report.searches_refine.searches);
      CHECK(run.published.not_a_disk == report.not_a_disk);
    }
  }
}

TEST_CASE("refused attempts show what they would have done, and by which gate") {
  // Plateaus and noise: many attempts fail.
  std::set<std::uint8_t> outcomes;
  std::size_t cones = 0;
  std::array<std::size_t, kRefusals> culprits{};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::uint8_t> samples(512);
    const std::uint32_t values = seed % 2 == 0 ? 3 : 256;
    for (std::uint8_t& s : samples) s = static_cast<std::uint8_t>(random.below(values));
    const Volume volume = Volume::from_samples({8, 8, 8}, {1, 1, 1}, samples);
    const Traced run = traced(volume, seed % 2 == 0 ? 0.5 : 127.5, Options{});
    check_replay(run);
    const TraceArrays& a = run.trace.arrays();
    std::array<std::size_t, kRefusals> refused{}, counted{};
    for (const OperationCounts& operation : run.report.operations) {
      for (std::size_t k = 0; k < kRefusals; ++k) counted[k] += operation.refused[k];
    }
    Complex complex;
    for (std::size_t e = 0; e < run.trace.size(); ++e) {
      replay(run.trace, e, complex);
      if (routine_of(run.trace, e) != Routine::count_ || is_done(run.trace, e)) continue;
      const auto refusal =
          static_cast<std::size_t>(a.outcome[e]) - static_cast<std::size_t>(TraceOutcome::count_);
      REQUIRE(refusal < kRefusals);
      ++refused[refusal];
      outcomes.insert(a.outcome[e]);
      // E is in the mesh.
      for (const Triangle& t : triangles_of(a.star, e)) CHECK(complex.count(rotated(t)) == 1);
      const auto cone = triangles_of(a.cone, e);
      cones += cone.size();
      const Vec3 from{a.edge[6 * e], a.edge[6 * e + 1], a.edge[6 * e + 2]},
          to{a.edge[6 * e + 3], a.edge[6 * e + 4], a.edge[6 * e + 5]};
      if (!is_finite(from)) continue;
      ++culprits[refusal];
      const Vec3 place{a.place[3 * e], a.place[3 * e + 1], a.place[3 * e + 2]};
      const auto at = [&](VertexId v) { return v == kNoId ? place : run.trace.point(v); };
      const auto is_far = [](double x, double y) { return std::abs(x - y) > 1e-4; };
      const bool is_dual_line = refusal == static_cast<std::size_t>(Refusal::no_surface_point);
      // A line whose points are equally far from the corners of a new facet, or an edge of one.
      CHECK(std::any_of(cone.begin(), cone.end(), [&](const Triangle& t) {
        std::size_t ends = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 p = at(t[i]), q = at(t[(i + 1) % 3]);
          if (is_dual_line && is_far(distance(from, p), distance(from, q))) return false;
          if (is_dual_line && is_far(distance(to, p), distance(to, q))) return false;
          if (distance(p, from) < 1e-4 || distance(p, to) < 1e-4) ++ends;
        }
        return is_dual_line || ends == 2;
      }));
    }
    CHECK(refused == counted);
  }
  CHECK(outcomes.size() >= 5);
  CHECK(cones > 100);
  CHECK(culprits[static_cast<std::size_t>(Refusal::no_surface_point)] > 10);
  CHECK(culprits[static_cast<std::size_t>(Refusal::turned)] > 10);
}

TEST_CASE("an operation is tried for a reason of its own, at a facet or a vertex of that mesh") {
  std::array<std::size_t, kOperations> tried{};
  for (const char* name : {"gyroid", "noise", "fuel"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 16);
    const Traced run = traced(scene, Options{});
    const TraceArrays& a = run.trace.arrays();
    Complex complex;
    for (std::size_t e = 0; e < run.trace.size(); replay(run.trace, e, complex), ++e) {
      if (routine_of(run.trace, e) != Routine::count_) continue;
      const auto operation = static_cast<Operation>(a.routine[e] - trace_code(Routine::count_));
      const Reason reason = reason_of(run.trace, e);
      CAPTURE(e);
      ++tried[static_cast<std::size_t>(operation)];
      CHECK((operation == Operation::removal) == (reason == Reason::unneeded));
      CHECK((operation == Operation::far_point) <= (reason == Reason::far_point));
      CHECK((operation == Operation::flip) <=
            (reason == Reason::not_delaunay || reason == Reason::too_near));
      CHECK(reason >= Reason::not_delaunay);
      const Triangle caller =
          triangle_of(a.caller[3 * e], a.caller[3 * e + 1], a.caller[3 * e + 2]);
      const bool is_of_vertex = caller[1] == kNoId;
      CHECK((reason == Reason::unneeded) <= is_of_vertex);
      if (is_of_vertex) {
        CHECK((reason == Reason::unneeded || reason == Reason::too_near));
        CHECK(caller[1] == kNoId);
        CHECK(std::ranges::any_of(
            complex, [&](const auto& facet) { return has_corner(facet.first, caller[0]); }));
      } else {
        CHECK(complex.count(rotated(caller)) == 1);
      }
      // Those that remove it remove what they were tried for.
      if (operation == Operation::removal && is_done(run.trace, e)) {
        const auto gone = triangles_of(a.removed, e);
        CHECK(
            std::ranges::all_of(gone, [&](const Triangle& t) { return has_corner(t, caller[0]); }));
      }
    }
  }
  for (std::size_t n = 0; n < kOperations; ++n) {
    CAPTURE(kOperationTable[n].name);
    CHECK(tried[n] > 0);
  }
}

TEST_CASE("searches and their voxels are counted event by event, each in its stage") {
  const Scene scene = builtin_scene("noise", 16);
  for_both_programs([&](const auto& options) {
    const Traced run = traced(scene, options);
    const TraceArrays& a = run.trace.arrays();
    SearchCounters in_recover = run.report.searches_coarsen, in_refine = run.report.searches_refine;
    in_recover += run.published.searches_recover;
    in_refine += run.published.searches_refine;
    REQUIRE(in_recover.searches > 0);
    for (const auto& [so_far, recover, refine] :
         {std::tuple(&a.searches, in_recover.searches, in_refine.searches),
          std::tuple(&a.computations, in_recover.computations, in_refine.computations)}) {
      CHECK(std::ranges::is_sorted(*so_far));
      for (std::size_t e = 0; e < run.trace.size(); ++e) {
        if (is_switch(routine_of(run.trace, e))) CHECK((*so_far)[e] == recover);
      }
      // A search after the last event, for a point that is then not inserted, is in none.
      CHECK(so_far->back() <= recover + refine);
      CHECK(so_far->back() > recover + refine - refine / 20);
    }
  });
}

TEST_CASE("every number of an event has a name") {
  std::set<std::string_view> names;
  std::size_t count = 0;
  const auto add = [&](std::size_t end, auto name_of_number) {
    for (std::size_t n = 0; n < end; ++n, ++count) {
      const auto name = name_of_number(n);
      CHECK(!name.text.empty());
      names.insert(name.name);
    }
  };
  const auto add_all = [&]<class Code>(Code end) {
    add(static_cast<std::size_t>(end), [](std::size_t n) { return name_of(static_cast<Code>(n)); });
  };
  add_all(Routine::count_);
  add_all(Reason::count_);
  add_all(PaperReason::count_);
  add_all(TraceOutcome::count_);
  add(kOperations, [](std::size_t n) { return routine_of(static_cast<Operation>(n)); });
  CHECK(names.size() == count);
}
