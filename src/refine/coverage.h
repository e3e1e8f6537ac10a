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

// Removes from `numbers` the samples within `limit` of a facet. Returns the others, the furthest
// first; of several with the same nearest facet only the furthest.
std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers);

// Returns how far the sample is from the mesh that is furthest from it. `resolution`: where the
// search for a nearest facet begins, about as large as most distances.
double furthest_distance(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples,
                         double resolution);

}  // namespace deliso
