// SPDX-License-Identifier: MIT
// The share by balls is that of a fresh triangulation, which knows nothing of balls.
#include "check/delaunay_share.h"

#include <doctest/doctest.h>

#include "cases.h"
#include "check/mesh_triangulation.h"
#include "coarsen/contour_as_mesh.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "mesh/meshes.h"
#include "run/report.h"

namespace deliso {
namespace {

CleanMesh clean(const TriMesh& mesh, const Volume& volume) {
  Faults faults;
  return check_validity(mesh, volume.box(), MayEnd::on_box, faults);
}

DelaunayShare by_balls(const CleanMesh& mesh, const Scene& scene, int threads = 1) {
  std::vector<double> heights;
  return measure_delaunay_share(mesh, VertexGrids(mesh.points, mesh.triangles), scene.surface,
                                heights, threads);
}

VoronoiEdges by_triangulation(const CleanMesh& mesh, const Scene& scene) {
  return count_voronoi_edges(mesh, scene.surface);
}

}  // namespace

// T's triangles are of all kinds; vertices moved at random keep their triangles.
TEST_CASE("facets and restricted facets are those of a Delaunay triangulation") {
  std::size_t outside = 0, facets_alone = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(60u); ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 9, {1, seed % 2 == 0 ? 1.0 : 0.4, 1});
    TriMesh mesh = contour_as_mesh(scene.contour).mesh;
    Random random(seed);
    for (Vec3& p : mesh.points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] += random.uniform(-0.01, 0.01);
    }
    const CleanMesh triangles = clean(mesh, scene.volume);
    const DelaunayShare share = by_balls(triangles, scene);
    const VoronoiEdges edges = by_triangulation(triangles, scene);
    CHECK(share.delaunay == edges.delaunay);
    CHECK(share.restricted == edges.restricted);
    CHECK(share.restricted + share.occupied + share.without_ball >= share.triangles);
    outside += share.triangles - share.delaunay;
    facets_alone += share.delaunay - share.restricted;
    const DelaunayShare in_threads = by_balls(triangles, scene, 3);
    CHECK(in_threads.delaunay == share.delaunay);
    CHECK(in_threads.restricted == share.restricted);
  }
  CHECK(outside > 100);
  CHECK(facets_alone > 10);
}

TEST_CASE("a mesh of DelIso has the share that a triangulation tells") {
  for (const char* name : {"linked_tori", "fuel", "gyroid"}) {
    CAPTURE(std::string(name));
    const Scene scene = builtin_scene(name, 24);
    Report report;
    const CleanMesh mesh =
        clean(mesh_isosurface(scene.volume, scene.surface.kappa(), {}, report), scene.volume);
    const DelaunayShare share = by_balls(mesh, scene);
    const VoronoiEdges edges = by_triangulation(mesh, scene);
    CHECK(share.delaunay == edges.delaunay);
    CHECK(share.restricted == edges.restricted);
    CHECK(share.share() > 0.98);
  }
}

// The exact test has a tie. The triangulation has one of the two diagonals of a square, so half of
// these triangles were no facets of it.
TEST_CASE("both diagonals of a square are Delaunay") {
  const Scene scene = builtin_scene("sphere", 24);
  for (const int diagonal : {0, 1}) {
    const TriMesh mesh = make_tri_mesh(
        {{0, 0, 8}, {8, 0, 8}, {8, 8, 8}, {0, 8, 8}},
        diagonal == 0 ? std::vector<Triangle>{triangle_of(0, 1, 2), triangle_of(0, 2, 3)}
                      : std::vector<Triangle>{triangle_of(0, 1, 3), triangle_of(1, 2, 3)});
    CHECK(by_balls(clean(mesh, scene.volume), scene).delaunay == 2);
  }
}

// The balls of large triangles lie beside thousands of vertices.
TEST_CASE("balls beside very many vertices are given up") {
  const Scene scene = builtin_scene("sphere", 24);
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  Random random(1);
  const auto add = [&](const Vec3& middle, double size) {
    const VertexId first(points.size());
    for (int n = 0; n < 3; ++n) {
      const Vec3 d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      points.push_back(middle + size / length(d) * d);
    }
    triangles.push_back({first, VertexId(first + 1), VertexId(first + 2)});
  };
  for (int n = 0; n < 4000; ++n) add({17, 17, 17}, 0.01);
  for (int n = 0; n < 4000; ++n) add({11, 11, 11}, 7);
  const CleanMesh mesh = clean(make_tri_mesh(points, triangles), scene.volume);
  for (const int threads : {1, 2}) {
    const DelaunayShare share = by_balls(mesh, scene, threads);
    CHECK_FALSE(share.measured);
    CHECK(share.restricted == 0);
  }
}

}  // namespace deliso
