// SPDX-License-Identifier: MIT
// Which way round components are: the sign of the volume that one bounds, together with the faces
// of the box that it meets. For what is thinner than a voxel gradients do not tell.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contour/contour.h"

namespace deliso {

// For every component of T a point in all the faces of the box that it meets: seen from there, what
// it leaves open has no volume behind it. Nothing for those that meet opposite faces.
std::vector<std::optional<Vec3>> component_origins(const ContourMesh& contour, const Box3& box);

// Six times the volume between triangles and the origin of their component, summed per component:
// positive where normals point away from what is bounded. `component`: per point; kNoId: left out.
// 0 where there is no origin.
std::vector<double> bounded_volumes(const std::vector<Vec3>& points,
                                    std::span<const std::array<VertexId, 3>> triangles,
                                    std::span<const std::uint32_t> component,
                                    std::span<const std::optional<Vec3>> origins, int threads = 1);

}  // namespace deliso
