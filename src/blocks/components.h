// SPDX-License-Identifier: MIT
// The components of the surface, from those of the blocks. Where two blocks meet, both have the
// same crossings of grid edges in the face between them; a crossing joins the components that it
// belongs to. So counts and topology are those of one contour of the whole volume, and components
// have the same order: by their first voxel.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/topology_counts.h"
#include "base/vec3.h"
#include "contour/contour.h"

namespace deliso {

// Orders points by their place.
inline auto by_place(const Vec3& p) {
  return std::tuple(p.x, p.y, p.z);
}

// What the contour of a block tells of the whole one. Voxels are those of the whole volume.
struct BlockComponents {
  struct Crossing {
    Vec3 point;
    std::uint32_t component;
  };
  // A piece of a boundary curve between two inner faces, by its ends.
  struct Arc {
    Vec3 from, to;
  };

  std::vector<ContourComponent> components;
  std::vector<Crossing> crossings;               // of the edges of inner faces
  std::vector<std::uint64_t> segments_on_inner;  // per component: sides of pieces in inner faces
  std::vector<Arc> arcs;
  std::uint64_t closed_curves = 0;  // boundary loops off the inner faces
};

// pre: `contour` is the plain one (build_contour()) of the block.
BlockComponents components_of(const ContourMesh& contour, const Volume& block);

struct AllComponents {
  std::vector<ContourComponent> components;  // of the whole contour; boundary loops are not counted
  std::vector<std::vector<std::uint32_t>> number;  // per block and component of it
  TopologyCounts topology;
};

// `dims`: of the whole volume.
AllComponents joined(std::span<const BlockComponents> blocks, Index3 dims);

}  // namespace deliso
