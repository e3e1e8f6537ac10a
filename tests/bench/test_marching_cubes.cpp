// SPDX-License-Identifier: MIT
// Whole meshes against the mesh checker: noise has all 256 cases, beside all neighbors.
#include "support/marching_cubes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "base/triangle.h"
#include "check/check_mesh.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

Volume noisy_volume(std::uint64_t seed, Index3 dims) {
  Random random(seed);
  std::vector<double> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) samples.push_back(random.uniform(-1, 1));
  return Volume::from_samples<double>(dims, {1, 1.5, 0.75}, samples);
}

}  // namespace

TEST_CASE("noise of every seed gives a manifold that is open at the box only") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const Volume volume = noisy_volume(seed, {9, 8, 10});
    const TriMesh mesh = marching_cubes(volume, 0.1);
    REQUIRE(mesh.faces.size() > 300);
    CHECK(check_mesh(mesh) == "");
    CHECK(check_boundary_on_box(mesh, volume.box()) == "");
    for (const Vec3& p : mesh.points) {
      REQUIRE(std::abs(volume.value(p) - 0.1) < 1e-12);
    }
  }
}

TEST_CASE("a sphere has one component, Euler number 2, its area, and normals that point outwards") {
  const Index3 dims{33, 33, 33};
  const Volume volume = sampled<double>(dims, {1, 1, 1}, [&](int i, int j, int k) {
    return 10 - length(Vec3{i - 16.1, j - 15.9, k - 16.2});
  });
  const TriMesh mesh = marching_cubes(volume, 0);
  const MeshTopology topology = mesh_topology(mesh);
  CHECK(topology.components.size() == 1);
  CHECK(topology.euler() == 2);
  CHECK(topology.boundary_loops == 0);
  double area = 0;
  for (const Face& face : mesh.faces) {
    const Vec3 &a = mesh.points[face.v[0]], &b = mesh.points[face.v[1]],
               &c = mesh.points[face.v[2]];
    const Vec3 normal = area_normal(a, b, c);
    area += 0.5 * length(normal);
    CHECK(dot(normal, a - Vec3{16.1, 15.9, 16.2}) >= 0);
  }
  CHECK(area == doctest::Approx(4 * std::numbers::pi * 100).epsilon(0.01));
}

TEST_CASE("a volume without voxels, and an isovalue without a surface, give an empty mesh") {
  CHECK(marching_cubes(noisy_volume(1, {5, 1, 5}), 0).faces.empty());
  CHECK(marching_cubes(noisy_volume(1, {5, 5, 5}), 2).faces.empty());
}
