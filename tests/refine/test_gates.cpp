// SPDX-License-Identifier: MIT
// Changes that one gate alone refuses. test_refinement.cpp has others.
#include <doctest/doctest.h>

#include <limits>

#include "coarsen/contour_as_mesh.h"
#include "mesh/meshes.h"
#include "refine/refinement.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

TEST_CASE("G0: a vertex of the chain comes to no other face of the box, and no other to any") {
  const Scene scene = builtin_scene("gyroid", 16);
  Stage stage(scene);
  const Box3 box = scene.volume.box();
  const BoundaryChain& chain = stage.surface_mesh.chain;
  int tried = 0;
  for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
    for (const VertexId v : stage.mesh.faces[f].v) {
      const unsigned faces = box_faces_at(stage.mesh.points[v], box);
      for (int face = 0; face < 6; ++face) {
        if ((faces >> (face & ~1) & 3) != 0) continue;
        const std::span<const FaceId> star = stage.r.star(f, v);
        Vec3 there = stage.mesh.points[v];
        there[face / 2] = (face & 1) != 0 ? box.hi[face / 2] : box.lo[face / 2];
        CHECK(make(stage.r,
                   {.cavity{star.begin(), star.end()},
                    .gates = kTopologyGates,
                    .apex = there,
                    .moved = v},
                   [](const Replacement&) { return false; }) == Refusal::frozen);
        tried += chain.is_boundary(v);
      }
    }
  }
  CHECK(tried > 100);
}

TEST_CASE("G1: no edge joins two vertices in a face of a block, at a seam or on the volume's box") {
  const Volume volume = make_builtin_volume("builtin:gyroid:16");
  Index3 end = volume.voxels();
  end.i /= 2;
  const Scene scene(samples_of(volume, {{0, 0, 0}, end}), 0);
  SurfaceMesh s = contour_as_mesh(scene.contour);
  s.duals.assign(s.mesh.faces.size(), {{}, std::numeric_limits<double>::infinity(), false});
  const BoundaryCurves curves(scene.surface,
                              std::make_shared<const BoundaryLoops>(scene.contour.boundary.loops));
  const Parameters parameters = resolve({}, volume);
  Report report;
  Refinement r(s, {scene.surface, curves, parameters, report});
  const auto faces_at = [&](VertexId v) {
    return box_faces_at(s.mesh.points[v], scene.volume.box());
  };
  int tried = 0;
  for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (s.mesh.faces[f].n[i] == kNoId) continue;
      const auto [g, a, b, c, d] = corners_at(s.mesh.faces, f, i);
      if ((faces_at(a) & faces_at(d)) == 0) continue;
      ++tried;
      CHECK(make(r, {.cavity = {f, g}, .facets = {{a, b, d}, {d, c, a}}},
                 [](const Replacement&) { return false; }) == Refusal::not_a_disk);
    }
  }
  CHECK(tried > 10);
}

TEST_CASE("G2: no component of eight facets is reversed") {
  const Scene scene = builtin_scene("sphere", 16);
  const BoundaryCurves curves(scene.surface, {});
  const Parameters parameters = resolve({}, scene.volume);
  Report report;
  SurfaceMesh s;
  s.mesh = make_tri_mesh({{9, 8, 8}, {7, 8, 8}, {8, 9, 8}, {8, 7, 8}, {8, 8, 9}, {8, 8, 7}},
                         octahedron());
  s.duals.assign(8, {{}, std::numeric_limits<double>::infinity(), false});
  Refinement r(s, {scene.surface, curves, parameters, report});
  FaceId f = 0;
  while (!has_corner(s.mesh.faces[f].v, VertexId(4))) ++f;
  const std::span<const FaceId> star = r.star(f, VertexId(4));
  const auto move_to = [&](double z) {
    return make(r,
                {.cavity{star.begin(), star.end()},
                 .gates{.least_cosine = kAnyFold, .surface_points = false},
                 .apex = Vec3{8, 8, z},
                 .moved = VertexId(4)},
                [](const Replacement&) { return false; });
  };
  CHECK(move_to(7.5) == Refusal::no_gain);
  CHECK(move_to(6.5) == Refusal::turned);
}

TEST_CASE("G3: a small facet without a surface point faces outwards") {
  const Scene scene = builtin_scene("sphere", 16);
  Stage stage(scene);
  stage.r.parameters.r_min = 100;
  int turned_over = 0;
  for (FaceId f = 0; f < stage.mesh.faces.size(); ++f) {
    // From beside the facet two of the cone's facets look inwards.
    const Vec3 a = stage.corner(f, 0), middle = 0.5 * (stage.corner(f, 1) + stage.corner(f, 2));
    const auto p = stage.r.finder.foot(a + 0.3 * (a - middle), stage.normal(f),
                                       stage.longest_edge(f), stage.report.searches_refine);
    if (!p) continue;
    const auto refusal = make(stage.r, {.cavity = {f}, .apex = *p},
                              [](const Replacement& c) { return !c.has_duals(); });
    CHECK(refusal != Refusal::no_gain);
    turned_over += refusal == Refusal::no_surface_point;
  }
  CHECK(turned_over > 50);
}

TEST_CASE("G5: no facet is a needle") {
  const Scene scene = builtin_scene("sphere", 16);
  Stage stage(scene);
  for (FaceId f = 0; f < stage.mesh.faces.size(); f = FaceId(f.number() + 7)) {
    const Vec3 a = stage.corner(f, 0), b = stage.corner(f, 1), c = stage.corner(f, 2);
    const Vec3 p = a + 0.5 * (b - a) + 1e-13 * (c - a);
    CHECK(make(stage.r, {.cavity = {f},
                         .gates{.least_cosine = kAnyFold, .surface_points = false},
                         .apex = p}) == Refusal::crossing);
  }
}
