// SPDX-License-Identifier: MIT
// F3 of coarsen/embedding.h: what it finds, and what it does not.
#include "coarsen/embedding.h"

#include <doctest/doctest.h>

#include <vector>

using namespace deliso;

namespace {

struct Octahedron {
  Vec3 center;
  double radius;
};

SurfaceMesh mesh_of(const std::vector<Octahedron>& all) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (const auto& [center, radius] : all) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        points.push_back(center);
        points.back()[axis] += sign * radius;
      }
    }
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const std::uint32_t x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
      const VertexId a(first + x), b(first + 2 + y), c(first + 4 + z);
      const bool is_odd = ((x + y + z) & 1) != 0;
      triangles.push_back(is_odd ? Triangle{a, c, b} : Triangle{a, b, c});
    }
  }
  SurfaceMesh s;
  s.mesh = make_tri_mesh(std::move(points), triangles);
  return s;
}

constexpr Box3 kBox{{0, 0, 0}, {40, 40, 40}};

// Returns the faults of a mesh that was another before.
EmbeddingFaults faults_of(const std::vector<Octahedron>& before,
                          const std::vector<Octahedron>& after, const FreeBox& free_box = {}) {
  const SurfaceMesh was = mesh_of(before), is = mesh_of(after);
  const MeshComponents components(was.mesh, was.chain, 0, kBox);
  const std::vector<std::uint8_t> changed(is.mesh.faces.size(), 1);
  return embedding_faults(is, components, changed, free_box, kBox);
}

}  // namespace

TEST_CASE("a component that was drawn through one sheet is found; beyond two sheets it is not") {
  const Octahedron large{{20, 20, 20}, 8}, left{{6, 20, 20}, 2};
  CHECK(faults_of({large, left}, {large, left}).none());
  CHECK(faults_of({large, left}, {large, {{5, 20, 20}, 1}}).none());

  const EmbeddingFaults inside = faults_of({large, left}, {large, {{20.5, 20, 20}, 2}});
  CHECK(inside.components == std::vector<std::uint32_t>{1, 1, 1});
  CHECK(inside.facets.size() == 3);
  // Beyond the free box facets may be missing.
  const FreeBox near{0, {17, 17, 17}, {23, 23, 23}};
  CHECK(faults_of({large, left}, {large, {{20.5, 20, 20}, 2}}, near).none());

  CHECK(faults_of({large, left}, {large, {{34, 20, 20}, 2}}).none());
}
