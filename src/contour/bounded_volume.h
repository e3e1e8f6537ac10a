// SPDX-License-Identifier: MIT
// The orientation of components: the sign of the volume that one bounds, together with the faces of
// the box that it meets. For components thinner than a voxel gradients give no orientation.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contour/contour.h"

namespace deliso {

// Returns for every component of T a point that lies in all faces of the box that the component
// meets. Seen from there, its open ends bound no volume. Nothing for components that meet opposite
// faces.
std::vector<std::optional<Vec3>> component_origins(const ContourMesh& contour, const Box3& box);

// Returns per component six times the volume between its triangles and its origin; 0 without an
// origin. It is positive if normals point away from the bounded volume. `component`: per point;
// points with kNoId are left out. The triangles are those of T or of a mesh.
template <class Triangle>
std::vector<double> bounded_volumes(const std::vector<Vec3>& points,
                                    const std::vector<Triangle>& triangles,
                                    std::span<const std::uint32_t> component,
                                    std::span<const std::optional<Vec3>> origins) {
  std::vector<double> volumes(origins.size(), 0);
  for (const Triangle& t : triangles) {
    const std::uint32_t c = component[t[0]];
    if (c == kNoId || !origins[c]) continue;
    const Vec3& o = *origins[c];
    volumes[c] += dot(points[t[0]] - o, cross(points[t[1]] - o, points[t[2]] - o));
  }
  return volumes;
}

}  // namespace deliso
