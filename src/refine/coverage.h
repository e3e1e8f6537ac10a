// SPDX-License-Identifier: MIT
// The distance from Sigma to the mesh, measured at reference samples. Facets can all be near Sigma
// and still miss a protrusion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Largest distance from a reference sample to the mesh, in bounds on h. With 1, meshes have 40 %
// more vertices.
inline constexpr double kCoverageDistances = 2;

// A sample too far from the mesh, and its nearest facet.
struct FarSample {
  std::uint32_t sample;
  FaceId facet;
  double distance2;
};

// Returns the squared distance of p from a facet.
double distance2_to_facet(const TriMesh& mesh, FaceId f, const Vec3& p);

// Returns the facet nearest to a sample at p, found in growing balls, the first of this radius;
// kNoId if all are very far.
FarSample nearest_facet(const TriMesh& mesh, const BoxGrid& grid, std::uint32_t sample,
                        const Vec3& p, double radius);

// Removes from `numbers` the samples within `limit` of a facet. Returns the others, the furthest
// first; of several with the same nearest facet only the furthest.
std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers);

}  // namespace deliso
