// SPDX-License-Identifier: MIT
// Distances of a whole mesh are those of its triangles, one by one.
#include "check/distances.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "coarsen/contour_as_mesh.h"
#include "fields.h"
#include "mesh/meshes.h"

using namespace deliso;

// The middle of an edge is searched once for its two triangles, each with a normal of its own.
TEST_CASE("the distances of a mesh are those of each triangle by itself") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 9);
    TriMesh mesh = contour_as_mesh(scene.contour).mesh;
    Random random(seed);
    for (Vec3& p : mesh.points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] += random.uniform(-0.2, 0.2);
    }
    Faults faults;
    const CleanMesh clean = check_validity(mesh, scene.volume.box(), MayEnd::on_box, faults);
    for (const double bound : {0.02, 1.0}) {
      constexpr double kLimit = 4;
      std::vector<TriangleDistances> of_triangles, of_one;
      const Distances all =
          distances_to_surface(clean, scene.surface, kLimit, {bound, 0}, 2, &of_triangles);
      REQUIRE(of_triangles.size() == clean.triangles.size());
      std::size_t beyond = 0, points = 0;
      double sum = 0;
      for (std::size_t n = 0; n < clean.triangles.size(); ++n) {
        CleanMesh one;
        for (const VertexId v : clean.triangles[n]) one.points.push_back(clean.points[v]);
        one.triangles = {{0, 1, 2}};
        one.uses = edge_uses(3, one.triangles);
        distances_to_surface(one, scene.surface, kLimit, {bound, 0}, 1, &of_one);
        for (std::size_t k = 0; k < of_one[0].size(); ++k) {
          const double d = of_one[0][k];
          if (d == std::numeric_limits<double>::infinity()) continue;
          CHECK(std::fabs(of_triangles[n][k] - d) < 1e-9);
          beyond += d > bound;
          sum += d;
          ++points;
        }
      }
      CHECK(points > 1000);
      CHECK(all.points == points);
      CHECK(all.beyond == beyond);
      CHECK(all.mean == doctest::Approx(sum / static_cast<double>(points)));
    }
  }
}

// Of a mesh that VTK had decimated, vertices a thousandth of a voxel outside the box were said to
// be two voxels off the surface, which they were .06 away from.
TEST_CASE("a vertex a little outside the box is as far from the surface as the point beside it") {
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 9);
    const Box3 box = scene.volume.box();
    const double limit = 4 * scene.volume.voxel(), step = 1e-3 * scene.volume.voxel();
    for (const Vec3& on : scene.contour.points) {
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_low = on[axis] == box.lo[axis];
        if (!is_low && on[axis] != box.hi[axis]) continue;
        Vec3 p = on;
        p[axis] += is_low ? -step : step;
        CHECK(std::fabs(distance_off_surface(p, scene.surface, 0, limit) - step) < 1e-6);
        ++tried;
      }
    }
  }
  CHECK(tried > 100);
}

// Where the gradient leads out of the box, a vertex .0008 voxel from the curve in the box's face
// was said to be .0011 off. Of a plane every place is as far as the gradient says.
TEST_CASE("a vertex in a face of the box is as far from the surface as from the curve there") {
  std::vector<float> samples;
  for_each_index({5, 5, 5}, [&](int i, int j, int k) {
    samples.push_back(static_cast<float>(4 * i + 5 * j + 6 * k));
  });
  const Scene scene(Volume::from_samples({5, 5, 5}, {1, 1, 1}, samples), 29.5);
  const Box3 box = scene.volume.box();
  const double step = 1e-3;
  std::size_t tried = 0;
  for (const Vec3& on : scene.contour.points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (on[axis] != box.lo[axis] && on[axis] != box.hi[axis]) continue;
      Vec3 along = scene.surface.gradient(on);
      along[axis] = 0;
      for (const double side : {-step, step}) {
        const Vec3 p = on + side / length(along) * along;
        if (!box.contains(p)) continue;
        CHECK(distance_off_surface(p, scene.surface, 0, 4) < 1.001 * step);
        ++tried;
      }
    }
  }
  CHECK(tried > 20);
}
