// SPDX-License-Identifier: MIT
// What a trace tells, against what came out: its facets replayed are the mesh, its zones are in
// conflict by exact predicates, and the run is the one that it would have been without.
#include "view/trace/recorder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/box3.h"
#include "delaunay/predicates.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "mesh/meshes.h"
#include "mesh/star.h"
#include "refine/refinement.h"
#include "view/trace/trace_names.h"

using namespace deliso;

namespace {

constexpr std::size_t kNoLimit = 1'000'000;

struct Traced {
  Trace trace{kNoLimit, false};
  TriMesh mesh;
  Report report;
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

// T2, and what the two complexes at the switch have to do with each other.
void check_replay(const Traced& run) {
  const Trace& trace = run.trace;
  REQUIRE(!trace.truncated());
  REQUIRE(trace.size() == trace.events_seen());
  Complex complex;
  int switches = 0;
  for (std::size_t e = 0; e < trace.size(); ++e) {
    if (routine_of(trace, e) == Routine::build_tri_mesh) {
      ++switches;
      std::multiset<Triangle> before, after;
      for (const auto& [t, count] : complex) before.insert(sorted(t));
      replay(trace, e, complex);
      for (const auto& [t, count] : complex) after.insert(sorted(t));
      CHECK(before == after);
      CHECK(triangles_of(trace.arrays().removed, e).size() == before.size());
    } else {
      replay(trace, e, complex);
    }
    if (!is_done(trace, e)) {
      CHECK(triangles_of(trace.arrays().removed, e).size() <=
            (trace.arrays().outcome[e] == trace_code(TraceOutcome::forgotten)));
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

Options paper_way() {
  Options options;
  options.recover = RecoverWay::paper;
  return options;
}

// As a trace has it.
Options undivided(Options options) {
  options.block_side = 0;
  return options;
}

}  // namespace

TEST_CASE("facets replayed are the mesh, and zones are in conflict, both ways") {
  for (const char* name : {"sphere", "torus", "fuel", "gyroid"}) {
    const Scene scene = builtin_scene(name, 24);
    for (const Options& options : {Options{}, paper_way()}) {
      CAPTURE(name);
      CAPTURE(static_cast<int>(options.recover));
      const Traced run = traced(scene.volume, scene.surface.kappa(), options);
      check_replay(run);
      const std::size_t cells = check_zones(run.trace);
      if (run.report.insertions_recover() > 0) CHECK(cells > run.report.insertions_recover());
      const auto inserted =
          std::count_if(run.trace.arrays().vertex.begin(), run.trace.arrays().vertex.end(),
                        [](std::uint32_t v) { return v != kNoId; });
      CHECK(static_cast<std::size_t>(inserted) >= run.report.insertions_recover());
    }
  }
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
    void operation_tried(const Question& question, Operation operation, const Proposal& proposal,
                         std::optional<Refusal> refusal) override {
      TraceRecorder::operation_tried(question, operation, proposal, refusal);
      worst.push_back(largest());
    }
    float largest() const {
      double h = 0;
      for (FaceId f = 0; f < surface_mesh->mesh.faces.size(); ++f) {
        if (is_dead(surface_mesh->mesh.faces[f])) continue;
        const Triangle& v = surface_mesh->mesh.faces[f].v;
        const auto& p = surface_mesh->mesh.points;
        const Dual& dual = surface_mesh->duals[f];
        const FacetShape shape = measure(p[v[0]], p[v[1]], p[v[2]], dual.center);
        if (shape.r > r_min) h = std::max(h, dual.on_surface ? shape.h : shape.r);
      }
      return static_cast<float>(h);
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
    const std::vector<float>& told = trace.arrays().worst;
    REQUIRE(told.size() > recorder.worst.size());
    const std::size_t stage1 = told.size() - recorder.worst.size();
    for (std::size_t e = 0; e < stage1; ++e) CHECK(std::isnan(told[e]));
    CHECK(std::equal(recorder.worst.begin(), recorder.worst.end(),
                     told.begin() + static_cast<std::ptrdiff_t>(stage1)));
    CHECK(told.back() == static_cast<float>(report.largest_h));
    CHECK(told.back() < told[stage1]);
  }
}

TEST_CASE("what calls for an insertion of the paper's is what the trace says") {
  std::map<Routine, int> asked;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14);
    Options options = paper_way();
    options.limits[Criterion::r_over_pole] = {0.5};
    options.samples = 8;
    const Traced run = traced(scene.volume, scene.surface.kappa(), options);
    check_replay(run);
    const Trace& trace = run.trace;
    const TraceArrays& a = trace.arrays();
    CHECK(check_zones(trace) > 0);
    const double size = length(scene.volume.box().size());
    for (std::size_t e = 0; e < trace.size(); ++e) {
      const auto hits = items<3>(a.hits, e);
      const auto star = triangles_of(a.star, e);
      const Triangle caller =
          triangle_of(a.caller[3 * e], a.caller[3 * e + 1], a.caller[3 * e + 2]);
      const Routine routine = routine_of(trace, e);
      ++asked[routine];
      if (routine == Routine::multi_intersect) {
        CHECK(hits.size() >= 2);
        CHECK(a.value[e] == static_cast<float>(hits.size()));
      }
      if (routine == Routine::multi_intersect || routine == Routine::approximate_geom) {
        // Each hit is as far from the facet's corners, as a Voronoi edge is.
        for (const auto& h : hits) {
          const Vec3 x{h[0], h[1], h[2]};
          const double r = distance(x, trace.point(caller[0]));
          CHECK(std::abs(distance(x, trace.point(caller[1])) - r) < 1e-5 * size);
          CHECK(std::abs(distance(x, trace.point(caller[2])) - r) < 1e-5 * size);
        }
      }
      if (routine == Routine::approximate_geom) CHECK(a.value[e] > 1);
      // Later events of the same cause, splits of boundary edges, tell no D_q again.
      if (routine == Routine::extract_manifold && !star.empty()) {
        const Star kind = classify_star(caller[0], star);
        CHECK((kind == Star::singular) == (reason_of(trace, e) == Reason::star_singular));
        if (kind == Star::disk) CHECK(reason_of(trace, e) == Reason::star_off_chain);
        CHECK(a.value[e] == static_cast<float>(star.size()));
      }
      if (routine == Routine::count_ && reason_of(trace, e) == Reason::count_) {
        CHECK(a.value[e] > 1);
      }
    }
  }
  for (const Routine routine :
       {Routine::init_triangulation, Routine::protect_boundary, Routine::multi_intersect,
        Routine::extract_manifold, Routine::approximate_geom, Routine::count_}) {
    CAPTURE(name_of(routine == Routine::count_ ? Routine::build_tri_mesh : routine).name);
    CHECK(asked[routine] > 0);
  }
}

TEST_CASE("labels replayed are those of the nearest site") {
  std::set<Reason> reasons;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14);
    const Traced run = traced(scene.volume, scene.surface.kappa(), Options{});
    check_replay(run);
    const Trace& trace = run.trace;
    const TraceArrays& a = trace.arrays();
    std::vector<std::uint32_t> label = a.contour_label;
    REQUIRE(label.size() == a.contour_points.size() / 3);
    REQUIRE(!label.empty());
    std::set<std::uint32_t> sites(label.begin(), label.end());
    for (std::size_t e = 0; e < trace.size(); ++e) {
      reasons.insert(reason_of(trace, e));
      for (const auto& [v, site] : items<2>(a.relabel, e)) {
        CHECK(site == a.vertex[e]);
        label[v] = site;
        sites.insert(site);
      }
    }
    for (std::size_t v = 0; v < label.size(); ++v) {
      const Vec3 p{a.contour_points[3 * v], a.contour_points[3 * v + 1],
                   a.contour_points[3 * v + 2]};
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::uint32_t s : sites) nearest = std::min(nearest, distance(p, trace.point(s)));
      CHECK(distance(p, trace.point(label[v])) < nearest + 1e-5);
    }
  }
  CHECK(reasons.count(Reason::region) == 1);
  CHECK(reasons.count(Reason::interface) == 1);
}

TEST_CASE("a limit keeps the first events, and counts the others") {
  const Scene scene = builtin_scene("fuel", 20);
  for (const Options& options : {Options{}, paper_way()}) {
    const Traced whole = traced(scene.volume, scene.surface.kappa(), options);
    for (const std::size_t limit :
         {std::size_t{1}, std::size_t{40}, whole.trace.size() - 1, whole.trace.size()}) {
      CAPTURE(limit);
      const Traced cut = traced(scene.volume, scene.surface.kappa(), options, limit);
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
  }
}

TEST_CASE("a traced run is the run without, and the same with any number of threads") {
  const Scene scene = builtin_scene("fuel", 32);
  for (Options options : {Options{}, paper_way(), Options::paper()}) {
    options.threads = 1;
    Report report;
    const TriMesh plain =
        mesh_isosurface(scene.volume, scene.surface.kappa(), undivided(options), report);
    const Traced one = traced(scene.volume, scene.surface.kappa(), options);
    options.threads = 4;
    const Traced four = traced(scene.volume, scene.surface.kappa(), options);
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
}

TEST_CASE("refused attempts show what they would have done, and by which gate") {
  // Plateaus: many attempts fail.
  std::set<std::uint8_t> outcomes;
  std::size_t cones = 0;
  std::array<std::size_t, kRefusals> culprits{};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::uint8_t> samples(512);
    for (std::uint8_t& s : samples) s = static_cast<std::uint8_t>(random.below(3));
    const Volume volume = Volume::from_samples({8, 8, 8}, {1, 1, 1}, samples);
    const Traced run = traced(volume, 0.5, Options{});
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
    const Traced run = traced(scene.volume, scene.surface.kappa(), Options{});
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
    CAPTURE(kOperationNames[n]);
    CHECK(tried[n] > 0);
  }
}

TEST_CASE("searches and their voxels are counted event by event, each in its stage") {
  const Scene scene = builtin_scene("noise", 16);
  for (const Options& options : {Options{}, paper_way()}) {
    const Traced run = traced(scene.volume, scene.surface.kappa(), options);
    const TraceArrays& a = run.trace.arrays();
    const Report& report = run.report;
    REQUIRE(report.searches_recover.searches > 0);
    for (const auto& [so_far, recover, refine] :
         {std::tuple(&a.searches, report.searches_recover.searches,
                     report.searches_refine.searches),
          std::tuple(&a.computations, report.searches_recover.computations,
                     report.searches_refine.computations)}) {
      CHECK(std::ranges::is_sorted(*so_far));
      for (std::size_t e = 0; e < run.trace.size(); ++e) {
        if (routine_of(run.trace, e) == Routine::build_tri_mesh) CHECK((*so_far)[e] == recover);
      }
      // A search after the last event, for a point that is then not inserted, is in none.
      CHECK(so_far->back() <= recover + refine);
      CHECK(so_far->back() > recover + refine - refine / 20);
    }
  }
}

TEST_CASE("every number of an event has a name") {
  std::set<std::string_view> names;
  for (std::size_t n = 0; n < static_cast<std::size_t>(Routine::count_); ++n) {
    const RoutineName name = name_of(static_cast<Routine>(n));
    CHECK(!name.text.empty());
    names.insert(name.name);
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(Reason::count_); ++n) {
    const ReasonName name = name_of(static_cast<Reason>(n));
    CHECK(!name.text.empty());
    names.insert(name.name);
  }
  for (std::size_t n = 0; n < kOperations; ++n) {
    const RoutineName name = routine_of(static_cast<Operation>(n));
    CHECK(!name.text.empty());
    names.insert(name.name);
  }
  CHECK(names.size() == static_cast<std::size_t>(Routine::count_) +
                            static_cast<std::size_t>(Reason::count_) + kOperations);
}
