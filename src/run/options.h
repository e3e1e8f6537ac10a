// SPDX-License-Identifier: MIT
// The options of a run of the exact program, as a user gives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "run/parameters.h"
#include "volume/volume.h"

namespace deliso {

// A length: in world units, as a share of the smallest side b of the box, or in voxels (`0.5vox`,
// Grid::voxel()). As a criterion's limit it may be a ratio, with Unit::world.
struct Length {
  enum class Unit : std::uint8_t { world, box, voxel };
  double value = 0;
  Unit unit = Unit::world;

  // Returns the length in the scaled frame.
  double in(const Grid& volume) const;
};

struct Options : RunSettings {
  static constexpr double kNone = kNotAsked;

  // Limits of Stage 2's criteria (run/criteria.h). The limit of r/l holds in Stage 1 too.
  // Infinite: no limit.
  PerCriterion<Length> limits = usual_limits();
  Length r_min{0.25, Length::Unit::voxel};  // facets with r <= r_min violate no criterion but r/l

  // About how many voxels a block has along each axis; 0: the volume is one block. So it is for an
  // observer of insertions.
  // kUsualSide: the samples decide, or usual_block_side() of blocks/grid.h.
  static constexpr int kUsualSide = -1;
  int block_side = kUsualSide;

  // The desired numbers of vertices and triangles, caps left out: no more than these. If one is
  // given, the bound on the distance follows from it.
  static constexpr std::size_t kNoTarget = std::numeric_limits<std::size_t>::max();
  std::size_t target_vertices = kNoTarget, target_triangles = kNoTarget;
  bool has_target() const { return target_vertices != kNoTarget || target_triangles != kNoTarget; }

  // How far vertices may then be off Sigma (more/counts/free_vertices.h).
  Length free_vertices;

  bool stop_after_stage1 = false;  // the mesh is the coarsened contour
  bool cap = false;                // close the mesh on the box (more/cap/close_on_box.h)

  static PerCriterion<Length> usual_limits();
};

// With a smaller r_min a run could not end in reasonable time (docs/proof.md, Theorem 5 and
// "Measured, not proven").
inline constexpr double kSmallestRMin = 0.001;  // voxels

// Throws InputError if r_min is smaller, or a criterion's limit is below its least.
void require_limits(const Options& options, const Grid& volume);

// Returns the options with all lengths in the scaled frame of the volume.
Parameters resolve(const Options& options, const Grid& volume);

}  // namespace deliso
