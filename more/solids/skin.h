// SPDX-License-Identifier: MIT
// What a solid is bounded by: triangles with a region on either side. Region 0 is outside and is
// not filled. An isosurface has one region, 1; a complex of labels has one a label.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

using RegionId = std::uint32_t;
inline constexpr RegionId kOutside = 0;

// Counter-clockwise seen from in front.
struct Wall {
  std::array<VertexId, 3> v;
  RegionId front = kOutside, behind = kOutside;
  std::uint32_t kind = 0;  // the user's; parts of a wall have its kind
};

// pre of all that take one: walls share edges and vertices only, and around each edge the regions
// follow each other, so that they are closed.
struct Skin {
  IdArray<VertexId, Vec3> points;
  std::vector<Wall> walls;
};

}  // namespace deliso
