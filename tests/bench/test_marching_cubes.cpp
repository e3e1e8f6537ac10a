// SPDX-License-Identifier: MIT
// All 256 cases against the definition of a consistent table, and whole meshes, noise included,
// against the mesh checker.
#include "support/marching_cubes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/random.h"
#include "base/triangle.h"
#include "check/check_mesh.h"
#include "contour/voxel_topology.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

using FaceSegment = std::pair<int, int>;

// The faces, 2 * axis + side, on which an edge lies.
std::set<int> faces_of(int edge) {
  const auto [low, high] = corners_of_edge(edge);
  std::set<int> faces;
  for (int axis = 0; axis < 3; ++axis) {
    if ((low >> axis & 1) == (high >> axis & 1)) faces.insert(2 * axis + (low >> axis & 1));
  }
  return faces;
}

// The directed sides of the case's triangles that no other triangle has the other way round.
std::set<FaceSegment> rim(int mask) {
  std::multiset<FaceSegment> sides;
  for (const VoxelTriangle& t : marching_cubes_case(mask)) {
    for (std::size_t i = 0; i < 3; ++i) sides.insert({t[i], t[(i + 1) % 3]});
  }
  std::set<FaceSegment> open;
  for (const FaceSegment& side : sides) {
    CHECK(sides.count(side) == 1);
    if (sides.count({side.second, side.first}) == 0) open.insert(side);
  }
  return open;
}

// The part of the rim in one face, with edges named by their middles in that face.
std::set<std::pair<std::pair<int, int>, std::pair<int, int>>> rim_in_face(int mask, int face) {
  const int axis = face / 2;
  const auto middle = [&](int edge) {
    const auto [low, high] = corners_of_edge(edge);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return std::pair((low >> u & 1) + (high >> u & 1), (low >> v & 1) + (high >> v & 1));
  };
  std::set<std::pair<std::pair<int, int>, std::pair<int, int>>> segments;
  for (const auto& [a, b] : rim(mask)) {
    if (faces_of(a).count(face) != 0 && faces_of(b).count(face) != 0) {
      segments.insert({middle(a), middle(b)});
    }
  }
  return segments;
}

Volume noisy_volume(std::uint64_t seed, Index3 dims) {
  Random random(seed);
  std::vector<double> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) samples.push_back(random.uniform(-1, 1));
  return Volume::from_samples<double>(dims, {1, 1.5, 0.75}, samples);
}

}  // namespace

TEST_CASE(
    "every case has corners on crossed edges, its boundary in faces, diagonals in the voxel") {
  std::size_t most = 0;
  for (int mask = 0; mask < 256; ++mask) {
    CAPTURE(mask);
    const std::vector<VoxelTriangle> triangles = marching_cubes_case(mask);
    most = std::max(most, triangles.size());
    std::set<int> used, crossed;
    for (const VoxelTriangle& t : triangles) used.insert(t.begin(), t.end());
    for (int e = 0; e < 12; ++e) {
      const auto [low, high] = corners_of_edge(e);
      if ((mask >> low & 1) != (mask >> high & 1)) crossed.insert(e);
    }
    CHECK(used == crossed);
    const std::set<FaceSegment> open = rim(mask);
    CHECK(open.size() == crossed.size());
    for (const VoxelTriangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        bool in_face = false;
        for (const int face : faces_of(a)) in_face = in_face || faces_of(b).count(face) != 0;
        CHECK(in_face == (open.count({a, b}) != 0));
      }
    }
  }
  CHECK(most >= 4);
  CHECK(most <= 5);
}

TEST_CASE("cases that can be neighbors have the same boundary in their common face") {
  int pairs = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // The rim in the high face of one, and in the low face of the other, by the face's four signs.
    std::map<int, std::set<std::pair<std::pair<int, int>, std::pair<int, int>>>> first;
    for (int mask = 0; mask < 256; ++mask) {
      int high = 0, low = 0;
      for (int m = 0, bit_high = 0, bit_low = 0; m < 8; ++m) {
        const int inside = mask >> m & 1;
        if ((m >> axis & 1) != 0) {
          high |= inside << bit_high++;
        } else {
          low |= inside << bit_low++;
        }
      }
      const auto from_high = rim_in_face(mask, 2 * axis + 1);
      CHECK(first.try_emplace(high, from_high).first->second == from_high);
      std::set<std::pair<std::pair<int, int>, std::pair<int, int>>> turned;
      for (const auto& [a, b] : rim_in_face(mask, 2 * axis)) turned.insert({b, a});
      CHECK(first.try_emplace(low, turned).first->second == turned);
      pairs += 2;
    }
    CHECK(first.size() == 16);
  }
  CHECK(pairs == 3 * 512);
}

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
