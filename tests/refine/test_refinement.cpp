// SPDX-License-Identifier: MIT
// The one operation and its gates. Gates: by changes made to fail each, which must leave every byte
// as it was. The link condition: against the changed mesh, for every collapse and flip of small
// meshes. test_storm.cpp has random changes.
#include "refine/refinement.h"

#include <doctest/doctest.h>

#include <limits>

#include "check/check_mesh.h"
#include "mesh/meshes.h"
#include "mesh/tri_mesh.h"
#include "refine/stage.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A mesh of no surface: combinatorics alone. All facets are such as need no surface point.
struct Bare {
  Bare(const TriMesh& mesh, const Scene& scene, const Parameters& parameters)
      : curves(scene.surface, {}) {
    surface_mesh.mesh = mesh;
    surface_mesh.duals.assign(mesh.faces.size(), {{}, kInfinity, false});
    Random random(9);
    for (Vec3& p : surface_mesh.mesh.points) {
      const Vec3 side = scene.volume.box().size();
      p = {side.x * random.uniform(), side.y * random.uniform(), side.z * random.uniform()};
    }
    r.emplace(surface_mesh, Given{scene.surface, curves, parameters, report});
  }
  // Whether G1 lets the change pass. Nothing is done.
  bool keeps_manifold(const Change& change) {
    const auto refusal = make(*r, change, [](const Replacement&) { return false; });
    REQUIRE(refusal);
    // Of points anywhere a change turns small components inside out.
    REQUIRE((refusal == Refusal::not_a_disk || refusal == Refusal::turned ||
             refusal == Refusal::uncovers || refusal == Refusal::no_gain));
    return refusal != Refusal::not_a_disk;
  }
  SurfaceMesh surface_mesh;
  Report report;
  BoundaryCurves curves;
  std::optional<Refinement> r;
};

// The mesh after the change, made anew from its triangles, whether or not it is one.
TriMesh changed_mesh(const TriMesh& mesh, const Change& change) {
  Triangles triangles;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    if (std::find(change.cavity.begin(), change.cavity.end(), f) != change.cavity.end()) continue;
    triangles.push_back(mesh.faces[f].v);
  }
  triangles.insert(triangles.end(), change.facets.begin(), change.facets.end());
  return make_tri_mesh(mesh.points, triangles);
}

bool same_topology(const TriMesh& a, const TriMesh& b) {
  return check_mesh(b).empty() && kinds_of(a) == kinds_of(b);
}

std::vector<TriMesh> small_meshes() {
  std::vector<TriMesh> meshes;
  for (const Triangles& triangles : {tetrahedron(), octahedron(), torus_grid(5, 4),
                                     torus_grid(3, 3), fan(7), annulus(), one_ring(4), l_shape()}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Random random(seed);
      TriMesh mesh = mesh_of(triangles);
      for (std::uint64_t n = 0; n < 3 * (seed - 1); ++n) {
        const FaceId f(random.below(static_cast<std::uint32_t>(mesh.faces.size())));
        const Vec3 p{random.uniform(), random.uniform(), random.uniform()};
        if (n % 2 == 0) {
          split_facet(mesh, f, p);
        } else {
          split_edge(mesh, f, static_cast<int>(random.below(3)), p);
        }
      }
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

}  // namespace

TEST_CASE("collapses pass the link condition exactly where they keep the mesh and its topology") {
  const Scene scene = builtin_scene("sphere", 16);
  const Parameters parameters = resolve({}, scene.volume);
  int allowed = 0, refused = 0;
  for (const TriMesh& mesh : small_meshes()) {
    Bare bare(mesh, scene, parameters);
    std::vector<bool> on_boundary(mesh.points.size(), false);
    for (const Face& face : mesh.faces) {
      for (int i = 0; i < 3; ++i) {
        if (face.n[i] != kNoId) continue;
        on_boundary[face.v[(i + 1) % 3]] = on_boundary[face.v[(i + 2) % 3]] = true;
      }
    }
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      for (int side = 0; side < 6; ++side) {
        const Triangle& v = mesh.faces[f].v;
        const int i = side % 3;
        const VertexId from = v[(i + 1 + side / 3) % 3], to = v[(i + 2 - side / 3) % 3];
        Change change;
        facets_around(mesh, f, from, change.cavity);
        for (const FaceId g : change.cavity) {
          Triangle t = mesh.faces[g].v;
          if (has_corner(t, to)) continue;
          std::replace(t.begin(), t.end(), from, to);
          change.facets.push_back(t);
        }
        if (change.facets.empty()) continue;
        const bool keeps = same_topology(mesh, changed_mesh(mesh, change));
        INFO("from ", from, " to ", to, " in ", mesh.faces.size(), " facets");
        // From the boundary inwards the new facets are two disks that meet in a vertex: refused,
        // though it would do.
        const bool into_inside = on_boundary[from] && mesh.faces[f].n[i] != kNoId;
        const bool passes = bare.keeps_manifold(change);
        if (passes) CHECK(keeps);
        if (!passes) CHECK((!keeps || into_inside));
        ++(passes ? allowed : refused);
      }
    }
  }
  CHECK(allowed > 1000);
  CHECK(refused > 500);
}

TEST_CASE("flips pass the link condition exactly where the other diagonal is no edge yet") {
  const Scene scene = builtin_scene("sphere", 16);
  const Parameters parameters = resolve({}, scene.volume);
  int allowed = 0, refused = 0;
  for (const TriMesh& mesh : small_meshes()) {
    Bare bare(mesh, scene, parameters);
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const FaceId g = mesh.faces[f].n[i];
        if (g == kNoId) continue;
        const Triangle& v = mesh.faces[f].v;
        const VertexId a = v[i], b = v[(i + 1) % 3], c = v[(i + 2) % 3];
        const VertexId d = mesh.faces[g].v[neighbor_index(mesh.faces[g], f)];
        Change change;
        change.cavity = {f, g};
        change.facets = {{a, b, d}, {d, c, a}};
        const bool keeps = same_topology(mesh, changed_mesh(mesh, change));
        CHECK(bare.keeps_manifold(change) == keeps);
        ++(keeps ? allowed : refused);
      }
    }
  }
  CHECK(allowed > 500);
  CHECK(refused > 50);
}

namespace {

// Proposes a cone from p over f: an insertion without its rules.
Proposal cone(Stage& stage, FaceId f, const Vec3& p, const Gates& gates = kInsertionGates) {
  const Cavity* cavity = stage.r.open({&f, 1});
  REQUIRE(cavity);
  return cavity->cone(p, gates);
}

}  // namespace

// docs/proof.md, Theorem 4: a hexagon and the rest of a sphere with three holes share every second
// edge of the hexagon. Joined in another order they are a torus with a hole.
TEST_CASE("G1 passes boundary runs joined in another order, which change the topology") {
  const Scene scene = builtin_scene("sphere", 16);
  const Parameters parameters = resolve({}, scene.volume);
  const TriMesh mesh = mesh_of({{0, 1, 2},
                                {0, 2, 3},
                                {0, 3, 4},
                                {0, 4, 5},  // the hexagon
                                {9, 1, 0},
                                {9, 0, 6},
                                {9, 6, 5},
                                {9, 5, 4},
                                {9, 4, 7},
                                {9, 7, 3},
                                {9, 3, 2},
                                {9, 2, 8},
                                {9, 8, 1}});
  Bare bare(mesh, scene, parameters);
  Change change;
  change.cavity = {FaceId(0), FaceId(1), FaceId(2), FaceId(3)};
  change.facets = {{0, 1, 4}, {0, 4, 5}, {0, 5, 2}, {0, 2, 3}};
  CHECK(bare.keeps_manifold(change));
  CHECK(kinds_of(mesh) == ComponentKinds{{-1, 3}});
  CHECK(kinds_of(changed_mesh(mesh, change)) == ComponentKinds{{-1, 1}});
}

TEST_CASE(
    "every gate refuses a change made to fail it, and a refusal leaves all bytes as they were") {
  const Scene scene = builtin_scene("linked_tori", 24);
  Options options;
  options.r_min = {0.05, Length::Unit::voxel};
  Stage stage(scene, options);
  REQUIRE(stage.fault() == "");
  const Stage::Snapshot before = stage.snapshot();

  // An insertion that would be done. It is at the end, too, when all else was refused.
  FaceId f = 0;
  while (!stage.surface_mesh.duals[f].on_surface) ++f;
  const auto good = [&] { return cone(stage, f, stage.surface_mesh.duals[f].center); };

  SUBCASE("a point of Sigma on another component") {
    const VertexId here = stage.mesh.faces[f].v[0];
    const std::vector<std::uint32_t> component =
        vertex_components(stage.mesh.points.size(), stage.mesh.triangles());
    int others = 0;
    for (VertexId v = 0; v < stage.mesh.points.size(); ++v) {
      if (component[v.number()] == component[here.number()]) continue;
      const auto refusal = stage.r.make(cone(stage, f, stage.mesh.points[v]));
      CHECK((refusal == Refusal::other_sheet || refusal == Refusal::turned));
      others += refusal == Refusal::other_sheet;
    }
    CHECK(others > 10);
  }
  SUBCASE("what is to go is no disk") {
    CHECK(!stage.r.open(std::array{f, f}));
    FaceId far = 0;
    while (far == f || has_corner(stage.mesh.faces[far].v, stage.mesh.faces[f].v[0]) ||
           has_corner(stage.mesh.faces[far].v, stage.mesh.faces[f].v[1]) ||
           has_corner(stage.mesh.faces[far].v, stage.mesh.faces[f].v[2])) {
      ++far;
    }
    CHECK(!stage.r.open(std::array{f, far}));
  }
  SUBCASE("what comes is no disk over that rim") {
    const auto with = [&](auto&& change) {
      good();  // opens its cavity
      const Cavity& cavity = stage.r.tried().cavity;
      std::vector<Triangle> facets = cavity.disk.facets;
      change(facets);
      return stage.r.make(cavity.fill(facets, kInsertionGates));
    };
    CHECK(with([](auto& facets) { facets.pop_back(); }) == Refusal::not_a_disk);
    CHECK(with([](auto& facets) { std::swap(facets[0][0], facets[0][1]); }) == Refusal::not_a_disk);
    CHECK(with([](auto& facets) { facets.push_back(Triangle(facets[0])); }) == Refusal::not_a_disk);
    CHECK(with([](auto& facets) { facets.clear(); }) == Refusal::not_a_disk);
  }
  SUBCASE("an edge that is there, and a facet that is there, from behind") {
    // Two facets at a vertex of three others: the flip's diagonal is the third edge.
    REQUIRE_FALSE(stage.r.make(good()));
    const std::vector<FaceId> created = stage.r.tried().created;
    const Stage::Snapshot with = stage.snapshot();
    const FaceId g = created[0], h = created[1];
    const Triangle t = stage.mesh.faces[g].v, s = stage.mesh.faces[h].v;
    VertexId a = kNoId, d = kNoId;
    for (const VertexId v : t) a = has_corner(s, v) ? a : v;
    for (const VertexId v : s) d = has_corner(t, v) ? d : v;
    const int i = corner_index(stage.mesh.faces[g], a);
    const Change flip{.cavity = {g, h}, .facets = {{a, t[(i + 1) % 3], d}, {d, t[(i + 2) % 3], a}}};
    CHECK(make(stage.r, flip) == Refusal::not_a_disk);
    CHECK(stage.snapshot() == with);
    // And back to the one facet that was there: a change of three for one.
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;  // the point may go
    CHECK_FALSE(make(stage.r, {.cavity = created, .facets = {before.faces[f].v}}));
    CHECK(stage.fault() == "");
    return;
  }
  SUBCASE("a facet without a surface point") {
    // Towards the middle of the hole in the torus no dual line meets the surface right.
    const Vec3 far = stage.corner(f, 0) + 100 * stage.normal(f) / length(stage.normal(f));
    CHECK(stage.r.make(cone(stage, f, far)) == Refusal::no_surface_point);
  }
  SUBCASE("an edge too sharp") {
    // The same points pass where no angle is asked for.
    int turned = 0;
    for (FaceId g = 0; g < stage.mesh.faces.size(); ++g) {
      const Vec3 up = stage.normal(g) / length(stage.normal(g));
      for (const double height : {0.05, 0.1, 0.2, 0.4}) {
        const auto raised = [&](double least_cosine) {
          const Vec3 middle = (stage.corner(g, 0) + stage.corner(g, 1) + stage.corner(g, 2)) / 3.0;
          const Vec3 apex = middle + height * stage.longest_edge(g) * up;
          return stage.r.make(cone(stage, g, apex, {.least_cosine = least_cosine}),
                              [](const Replacement&) { return false; });
        };
        if (raised(0.9999) != Refusal::turned) continue;
        ++turned;
        CHECK(raised(kAnyFold) == Refusal::no_gain);
      }
    }
    CHECK(turned > 20);
  }
  SUBCASE("the proposer does not want it") {
    std::size_t asked = 0;
    CHECK(stage.r.make(good(), [&](const Replacement& change) {
      CHECK(change.duals.size() == asked++);                        // one more each time
      CHECK(stage.mesh.points.size() == before.points.size() + 1);  // in its place
      CHECK(stage.mesh.points.back() == change.proposal.place);
      return !change.has_duals();
    }) == Refusal::no_gain);
    CHECK(asked == 4);
  }
  CHECK(stage.snapshot() == before);

  CHECK_FALSE(stage.r.make(good()));
  CHECK(stage.r.created().size() == 3);
  CHECK(stage.fault() == "");
  CHECK(stage.fault_of(stage.r.created()) == "");
}

TEST_CASE("proposals of a cavity can be made in any order, until one is done or another is open") {
  const Scene scene = builtin_scene("sphere", 16);
  Stage stage(scene);
  FaceId f = 0, g = 1;
  while (!stage.surface_mesh.duals[f].on_surface) ++f;
  while (has_corner(stage.mesh.faces[g].v, stage.mesh.faces[f].v[0])) ++g;
  const Vec3 far = stage.corner(f, 0) + 100 * stage.normal(f) / length(stage.normal(f));
  const auto propose = [&] {
    const Cavity* cavity = stage.r.open({&f, 1});
    REQUIRE(cavity);
    return std::pair{cavity->cone(stage.surface_mesh.duals[f].center, kInsertionGates),
                     cavity->cone(far, kInsertionGates)};
  };
  const Stage::Snapshot before = stage.snapshot();
  const auto [old, unused] = propose();
  REQUIRE(stage.r.open({&g, 1}));
  CHECK_THROWS_AS(stage.r.make(old), InternalError);
  const auto [good, bad] = propose();
  CHECK(stage.r.make(bad));
  CHECK(stage.r.make(bad));
  CHECK(stage.snapshot() == before);
  CHECK_FALSE(stage.r.make(good));
  CHECK_THROWS_AS(stage.r.make(good), InternalError);  // its facets are gone
  CHECK(stage.fault() == "");
}

// Two sheets close to each other, and vertices of one pulled through the other and back. What the
// gates before would say is set aside: no facet is held to have a surface point.
TEST_CASE(
    "G5 is exact: every change that it refuses would cross, and no change that is made does") {
  const Scene scene(sampled<float>({8, 8, 8}, {1, 1, 1},
                                   [&](int i, int j, int k) {
                                     const double bend = 0.3 * std::sin(0.7 * i + 0.4 * j);
                                     return 1 - std::abs(k - 3.5 - bend) / 0.8;
                                   }),
                    0.3);
  Options options;
  options.r_min = {0.3, Length::Unit::voxel};
  Stage stage(scene, options, true);
  REQUIRE(mesh_topology(stage.mesh).components.size() == 2);
  REQUIRE(stage.fault() == "");
  Random random(3);
  int crossing = 0, done = 0;
  for (int n = 0; n < 1500; ++n) {
    CAPTURE(n);
    const FaceId f = stage.random_facet(random);
    const VertexId v = stage.mesh.faces[f].v[random.below(3)];
    if (stage.surface_mesh.chain.is_boundary(v)) continue;
    const std::span<const FaceId> star = stage.r.star(f, v);
    for (const FaceId g : star) stage.surface_mesh.duals[g] = {{}, kInfinity, false};
    const Vec3 from = stage.mesh.points[v], up = stage.normal(f) / length(stage.normal(f));
    const Vec3 aside{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0};
    const Vec3 to = from + random.uniform(-2, 1) * up + aside;
    TriMesh moved = stage.mesh;
    moved.points[v] = to;
    if (!scene.volume.box().contains(to)) continue;
    const bool crosses = !crossing_in(moved).empty();
    const Stage::Snapshot before = stage.snapshot();
    // No duals are asked for: the place may lie off Sigma.
    Change change{.cavity{star.begin(), star.end()},
                  .gates{.least_cosine = kAnyFold, .surface_points = false},
                  .apex = to,
                  .moved = v};
    const auto refusal = make(stage.r, change);
    REQUIRE((refusal == Refusal::crossing) == crosses);
    ++(crosses ? crossing : done);
    if (refusal) {
      REQUIRE(refusal == Refusal::crossing);
      REQUIRE(stage.snapshot() == before);
      continue;
    }
    REQUIRE(crossing_in(moved).empty());
    for (const FaceId g : change.cavity) stage.surface_mesh.duals[g] = {{}, kInfinity, false};
    change.apex = from;
    REQUIRE_FALSE(make(stage.r, change));
  }
  MESSAGE(crossing << " would have crossed, " << done << " did not");
  CHECK(crossing > 300);
  CHECK(done > 300);
}
