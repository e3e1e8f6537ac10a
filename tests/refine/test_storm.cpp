// SPDX-License-Identifier: MIT
// A storm for each operation of Stage 2 (storm.h): at random places of meshes of all kinds, and
// with criteria so strict that there is work for it everywhere.
#include <limits>
#include <set>

#include "base/triangle.h"
#include "refine/operations.h"
#include "refine/storm.h"
#include "refine/thin.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::uint64_t done(const Stage& stage, Operation operation) {
  return stage.report[operation].done;
}

double nearest_new_facet(const Stage& stage, const Vec3& p) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const FaceId f : stage.r.created()) {
    nearest2 = std::min(nearest2, distance2_to_triangle(p, stage.corner(f, 0), stage.corner(f, 1),
                                                        stage.corner(f, 2)));
  }
  return std::sqrt(nearest2);
}

// The facets connected with `start` whose balls hold p, by going over all of them until none is
// new.
std::set<FaceId> encroached(const Stage::Snapshot& mesh, FaceId start, const Vec3& p) {
  std::set<FaceId> disk{start};
  for (bool grown = true; grown;) {
    grown = false;
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      const Face& face = mesh.faces[f];
      if (is_dead(face) || disk.contains(f) || !mesh.duals[f].holds(p)) continue;
      const auto is_in = [&](FaceId g) { return g != kNoId && disk.contains(g); };
      if (std::ranges::none_of(face.n, is_in)) continue;
      disk.insert(f);
      grown = true;
    }
  }
  return disk;
}

// Insertions at the facet's surface point, near it and at a vertex of T, and splits of edges.
struct Insertion {
  int boundary_side = -1;  // split, if any
  std::optional<Vec3> p;
  std::uint64_t splits_before = 0;
  std::size_t splits = 0, splits_refused = 0;

  bool prepare(Stage& stage, const Try& now, Random& random) {
    boundary_side = -1;
    p.reset();
    splits_before = done(stage, Operation::boundary_split);
    const std::uint32_t kind = random.below(8);
    const std::array<FaceId, 3>& beyond = stage.mesh.faces[now.f].n;
    const std::vector<Vec3>& samples = stage.coarsened.samples;
    if (kind == 0) {
      for (int i = 0; i < 3; ++i) boundary_side = beyond[i] == kNoId ? i : boundary_side;
    } else if (kind < 4) {
      const Dual& dual = stage.surface_mesh.duals[now.f];
      if (dual.on_surface) p = dual.center;
    } else {
      p = kind < 6 ? stage.point_near(now.f, random)
                   : samples[random.below(static_cast<std::uint32_t>(samples.size()))];
    }
    return p || boundary_side >= 0;
  }
  std::optional<Refusal> attempt(Stage& stage, const Try& now) {
    if (p) return insert_point(stage.r, Operation::foot, now.f, *p);
    const auto refusal = split_boundary_edge(stage.r, {now.f, boundary_side});
    ++(refusal ? splits_refused : splits);
    return refusal;
  }
  // The new vertex is in all new facets, and nothing else was touched.
  void check(Stage& stage, const Try& now) {
    const TriMesh& mesh = stage.mesh;
    const Stage::Snapshot& before = now.before;
    REQUIRE(mesh.points.size() == before.points.size() + 1);
    const auto v = VertexId(before.points.size());
    const std::set<FaceId> is_new(stage.r.created().begin(), stage.r.created().end());
    REQUIRE(is_new.size() == stage.r.created().size());
    for (const FaceId f : is_new) REQUIRE(has_corner(mesh.faces[f].v, v));
    for (FaceId f = 0; f < before.faces.size(); ++f) {
      if (!is_new.contains(f)) REQUIRE(mesh.faces[f].v == before.faces[f].v);
    }
    const std::uint64_t splits_now = done(stage, Operation::boundary_split);
    CHECK(done(stage, Operation::foot) + splits_now == stage.report.insertions_refine);
    CHECK(stage.report.insertions_refine == mesh.points.size() - stage.report.vertices_coarsened);
    if (!p) CHECK(splits_now == splits_before + 1);
    if (splits_now > splits_before) return;
    REQUIRE(mesh.points.back() == *p);
    REQUIRE(stage.live_facets() == live_facets(before.faces) + 2);
    for (const FaceId g : encroached(before, now.f, *p)) {
      REQUIRE((is_dead(mesh.faces[g]) || mesh.faces[g].v != before.faces[g].v));
    }
  }
};

Storm storm_of(Insertion& insertion, int tries, std::function<Options(int)> options) {
  return {100,
          tries,
          std::move(options),
          [&](Stage& s, Try& now, Random& random) { return insertion.prepare(s, now, random); },
          [&](Stage& s, const Try& now) { return insertion.attempt(s, now); },
          [&](Stage& s, const Try& now) { insertion.check(s, now); }};
}

}  // namespace

TEST_CASE("every insertion keeps the mesh valid; a refused one changes nothing") {
  Insertion insertion;
  const StormTally tally = run_storm(storm_of(insertion, 160, [](int) { return with_r_min(0.1); }));
  MESSAGE(tally.done << " done, " << tally.refused << " refused, of these " << insertion.splits
                     << " and " << insertion.splits_refused << " splits of edges");
  CHECK(tally.done > 800 + insertion.splits);
  CHECK(tally.refused > 200);
  CHECK(insertion.splits > 20);
  for (const Refusal refusal :
       {Refusal::not_a_disk, Refusal::crossing, Refusal::no_surface_point}) {
    CHECK(tally[refusal] > 0);
  }
}

// With a large r_min the gates before the exact one let nearly everything pass.
TEST_CASE("insertions keep the mesh valid where no facet is large enough to need a surface point") {
  Insertion insertion;
  const StormTally tally =
      run_storm(storm_of(insertion, 80, [](int n) { return with_r_min(n % 2 == 0 ? 0.6 : 3.0); }));
  MESSAGE(tally.done << " done, " << tally.refused << " refused");
  CHECK(tally.done > 100 + insertion.splits);
  CHECK(tally[Refusal::too_close] > 50);
}

// New vertices and flips that nobody wants give it work: the edges around them are tried, and one
// from anywhere.
TEST_CASE(
    "only edges that are not Delaunay are flipped; flips lower the radii, the mesh stays valid") {
  std::vector<EdgeRef> waiting;
  EdgeRef edge;
  std::size_t refused = 0, delaunay = 0;
  const auto is_wanted = [](const Stage::Snapshot& mesh, EdgeRef e) {
    const FaceId g = mesh.faces[e.face].n[e.index];
    if (g == kNoId) return false;
    const Corners4 q = corners_at(mesh.faces, e.face, e.index);
    return mesh.duals[e.face].holds(mesh.points[q.d]) || mesh.duals[g].holds(mesh.points[q.a]);
  };
  const StormTally tally =
      run_storm({500, 400, [](int) { return with_r_min(0.1); },
                 [&](Stage& stage, Try& now, Random& random) {
                   if (now.number == 0) waiting.clear();
                   if (waiting.empty()) {
                     std::vector<FaceId> made;
                     const int i = static_cast<int>(random.below(3));
                     if (random.below(3) == 0) {
                       insert_near(stage, now.f, random);
                     } else if (stage.flip_anyway(now.f, i, &made)) {
                       REQUIRE(stage.fault() == "");
                     }
                     waiting.push_back({stage.random_facet(random), i});
                     for (const FaceId g : made)
                       waiting.insert(waiting.end(), {{g, 0}, {g, 1}, {g, 2}});
                   }
                   edge = waiting.back();
                   waiting.pop_back();
                   return !is_dead(stage.mesh.faces[edge.face]);
                 },
                 [&](Stage& stage, const Try& now) {
                   const auto refusal = flip_if_not_delaunay(stage.r, edge.face, edge.index);
                   if (refusal) ++(is_wanted(now.before, edge) ? refused : delaunay);
                   return refusal;
                 },
                 [&](Stage& stage, const Try& now) {
                   const Stage::Snapshot& before = now.before;
                   REQUIRE(is_wanted(before, edge));
                   REQUIRE(stage.r.created().size() == 2);
                   REQUIRE(stage.mesh.points.size() == before.points.size());
                   const Corners4 q = corners_at(before.faces, edge.face, edge.index);
                   double radii = 0;
                   for (const FaceId g : stage.r.created()) {
                     const Dual& dual = stage.surface_mesh.duals[g];
                     const Triangle& v = stage.mesh.faces[g].v;
                     CHECK(dual.on_surface);
                     CHECK(has_corner(v, q.a));
                     CHECK(has_corner(v, q.d));
                     for (const VertexId other : {q.a, q.b, q.c, q.d}) {
                       if (!has_corner(v, other)) CHECK_FALSE(dual.holds(stage.mesh.points[other]));
                     }
                     radii += std::sqrt(dual.radius2);
                   }
                   CHECK(radii < std::sqrt(before.duals[edge.face].radius2) +
                                     std::sqrt(before.duals[q.g].radius2));
                 }});
  MESSAGE(tally.done << " flipped, " << refused << " refused, " << delaunay << " not called for");
  CHECK(tally.done > 500);
  CHECK(refused > 100);
  CHECK(delaunay > 500);
}

// Also along the box. The vertex that went lies near the facets that replaced it (G4). Vertices
// that insertion made stay.
TEST_CASE("every collapse removes one vertex of Stage 1 and keeps the mesh valid") {
  StormTally tally;
  std::size_t on_boundary = 0;
  const std::pair<double, double> criteria[] = {{0.6, 3}, {1.2, 1}, {0.8, 0.5}};
  for (const auto& [lambda, r_min] : criteria) {
    Options options = with_r_min(r_min);
    options.limits[Criterion::r_over_l].value = lambda;
    const auto ratio = [](const std::vector<Vec3>& p, const Triangle& v) {
      return distance(circumcenter(p[v[0]], p[v[1]], p[v[2]]), p[v[0]]) /
             std::sqrt(shortest_edge2(p[v[0]], p[v[1]], p[v[2]]));
    };
    run_storm({900, 60, [&](int) { return options; },
               [](Stage& stage, Try& now, Random& random) {
                 if (random.below(8) != 0) return true;
                 insert_near(stage, now.f, random);
                 return false;
               },
               [](Stage& stage, const Try& now) { return collapse_short_edge(stage.r, now.f); },
               [&](Stage& stage, const Try& now) {
                 const std::vector<Vec3>& p = now.before.points;
                 REQUIRE(stage.mesh.points == p);  // vertices neither come nor move
                 const Triangle& asked = now.before.faces[now.f].v;
                 const double limit = stage.parameters.refinement[Criterion::r_over_l];
                 REQUIRE(ratio(p, asked) > limit);
                 REQUIRE(shortest_edge2(p[asked[0]], p[asked[1]], p[asked[2]]) <
                         stage.parameters.r_min * stage.parameters.r_min);
                 const std::vector<std::uint8_t> was = is_used(now.before.faces, p.size());
                 const std::vector<std::uint8_t> is = is_used(stage.mesh.faces, p.size());
                 REQUIRE(std::ranges::count(is, 1) == std::ranges::count(was, 1) - 1);
                 for (std::size_t v = stage.report.vertices_coarsened; v < is.size(); ++v)
                   REQUIRE(is[v]);
                 on_boundary += stage.snapshot().links.size() < now.before.links.size();
                 double worst = 0;
                 for (const Face& face : now.before.faces) {
                   if (!is_dead(face)) worst = std::max(worst, ratio(p, face.v));
                 }
                 for (const FaceId g : stage.r.created()) {
                   CHECK(ratio(p, stage.mesh.faces[g].v) <= 2.0001 * worst);
                 }
                 for (const Triangle& t : stage.r.tried().cavity.disk.facets) {
                   for (const VertexId v : t) {
                     CHECK(nearest_new_facet(stage, p[v]) <=
                           2 * stage.parameters.refinement[Criterion::distance]);
                   }
                 }
               }},
              tally);
  }
  MESSAGE(tally.done << " collapsed, " << tally.refused << " refused; " << on_boundary
                     << " on the boundary");
  CHECK(tally.done > 100);
  CHECK(tally.refused > 100);
  CHECK(on_boundary > 10);
}

// One vertex that is not on the boundary, not far, and duals around it.
TEST_CASE("every move keeps the mesh valid, on meshes of all kinds and after random insertions") {
  const StormTally tally =
      run_storm({1100, 70,
                 [](int n) {
                   Options options = with_r_min(n % 2 == 0 ? 0.3 : 1.0);
                   options.limits[Criterion::r_over_l].value = 1;
                   options.limits[Criterion::distance] = {0.02, Length::Unit::voxel};
                   return options;
                 },
                 [](Stage& stage, Try& now, Random& random) {
                   if (random.below(4) != 0) return true;
                   insert_near(stage, now.f, random);
                   return false;
                 },
                 [](Stage& stage, const Try& now) { return move_corner(stage.r, now.f); },
                 [](Stage& stage, const Try& now) {
                   const std::vector<Vec3>&is = stage.mesh.points, &was = now.before.points;
                   REQUIRE(is.size() == was.size());
                   std::size_t moved = 0;
                   for (VertexId v = 0; v < was.size(); ++v) {
                     if (is[v] == was[v]) continue;
                     ++moved;
                     CHECK_FALSE(stage.surface_mesh.chain.is_boundary(v));
                     CHECK(distance(is[v], was[v]) < 2 * stage.parameters.r_min);
                   }
                   REQUIRE(moved == 1);
                   for (FaceId f = 0; f < now.before.faces.size(); ++f) {
                     REQUIRE(stage.mesh.faces[f].v == now.before.faces[f].v);
                     REQUIRE(stage.mesh.faces[f].n == now.before.faces[f].n);
                   }
                 }});
  MESSAGE(tally.done << " moved, " << tally.refused << " not");
  CHECK(tally.done > 200);
  CHECK(tally.refused > 100);
}

TEST_CASE(
    "every removal keeps the mesh valid and within the criteria; a refused one changes nothing") {
  std::optional<Thinning> thinning;
  std::size_t on_boundary = 0;
  const StormTally tally = run_storm(
      {0, 120, [](int) { return Options{}; },
       [&](Stage& stage, Try& now, Random&) {
         if (now.number == 0) {
           allow_coarser(stage);
           thinning.emplace(stage.r, all_vertices(stage.mesh));
         }
         return thinning->has_next();
       },
       [&](Stage&, const Try&) { return thinning->remove_next(); },
       [&](Stage& stage, const Try& now) {
         REQUIRE(stage.mesh.points == now.before.points);  // vertices neither come nor move
         for (const FaceId f : stage.r.created()) {
           CHECK(stage.surface_mesh.duals[f].on_surface);
           CHECK(violation(stage.r.shape(f), stage.r.parameters.refinement) <= 1);
           CHECK(stage.is_delaunay(f));
         }
         const VertexId gone = removed_vertex(stage.r.tried());
         CHECK(nearest_new_facet(stage, stage.mesh.points[gone]) <=
               stage.r.parameters.refinement[Criterion::distance]);
         const auto was_gone = [&](const auto& link) { return link.first == gone; };
         on_boundary += std::ranges::any_of(now.before.links, was_gone);
       },
       true});
  MESSAGE(tally.done << " removed, " << on_boundary << " of them on the box, " << tally.refused
                     << " refused");
  CHECK(tally.done > 500);
  CHECK(tally.refused > 500);
  CHECK(on_boundary > 20);
}

namespace {

// A change by hand near f: a cone over a random patch, a collapse, a move, a flip, another
// triangulation of a star.
Change random_change(Stage& stage, FaceId f, Random& random) {
  const TriMesh& mesh = stage.mesh;
  Change made;
  if (random.below(2) == 0) made.gates = Gates{};
  const std::uint32_t kind = random.below(5);
  const int i = static_cast<int>(random.below(3));
  const VertexId v = mesh.faces[f].v[i], w = mesh.faces[f].v[(i + 1) % 3];
  if (kind == 0) {  // a cone over a patch grown at random
    made.cavity.assign(1, f);
    for (std::uint32_t n = random.below(5); n > 0; --n) {
      const auto size = static_cast<std::uint32_t>(made.cavity.size());
      const FaceId g = mesh.faces[made.cavity[random.below(size)]].n[random.below(3)];
      if (g != kNoId && std::ranges::count(made.cavity, g) == 0) made.cavity.push_back(g);
    }
    made.apex = stage.point_near(f, random).value_or(stage.coarsened.samples[0]);
    return made;
  }
  facets_around(mesh, f, v, made.cavity);
  if (kind == 1 && !stage.surface_mesh.chain.is_boundary(v)) {  // a collapse of v into w
    for (const FaceId g : made.cavity) {
      Triangle t = mesh.faces[g].v;
      if (has_corner(t, w)) continue;
      std::replace(t.begin(), t.end(), v, w);
      made.facets.push_back(t);
    }
  } else if (kind == 2 && !stage.surface_mesh.chain.is_boundary(v)) {  // a move of v
    made.moved = v;
    made.apex = stage.point_near(f, random).value_or(mesh.points[v]);
  } else if (kind == 3) {  // the star triangulated from w
    Disk star;
    for (const FaceId g : made.cavity) star.facets.push_back(mesh.faces[g].v);
    REQUIRE(star.link());
    for (const Disk::BoundaryEdge& e : star.boundary) {
      if (e.from != w && e.to != w) made.facets.push_back({e.from, e.to, w});
    }
  } else {  // a flip
    made.cavity.assign(1, f);
    if (mesh.faces[f].n[i] == kNoId) return made;
    const Corners4 q = corners_at(mesh.faces, f, i);
    made.cavity.push_back(q.g);
    made.facets = {{q.a, q.b, q.d}, {q.d, q.c, q.a}};
  }
  return made;
}

}  // namespace

// Boundary changes are the operations', with the chain.
TEST_CASE("thousands of random changes: the mesh stays valid, and a refused one changes nothing") {
  Change made;
  const StormTally tally =
      run_storm({300, 350, [](int n) { return with_r_min(n % 3 == 0 ? 0.1 : 2.0); },
                 [&](Stage& stage, Try& now, Random& random) {
                   made = random_change(stage, now.f, random);
                   return true;
                 },
                 [&](Stage& stage, const Try&) -> std::optional<Refusal> {
                   const bool on_boundary = std::ranges::any_of(made.cavity, [&](FaceId f) {
                     return std::ranges::count(stage.mesh.faces[f].n, kNoId) > 0;
                   });
                   return make(stage.r, made, [&](const Replacement&) { return !on_boundary; });
                 },
                 [](Stage&, const Try&) {}});
  MESSAGE(tally.done << " done, " << tally.refused << " refused");
  CHECK(tally.done > 1000);
  for (const Refusal refusal :
       {Refusal::not_a_disk, Refusal::no_surface_point, Refusal::turned, Refusal::crossing}) {
    CAPTURE(name_of(refusal));
    CHECK(tally[refusal] > 10);
  }
}
