// SPDX-License-Identifier: MIT
// The options of a run, as a user gives them: the paper's parameters (§3.1, §3.2), and ours.
#pragma once

#include <cstddef>
#include <cstdint>

#include "roots/cubic.h"
#include "surface/parameters.h"
#include "volume/volume.h"

namespace deliso {

// A length: in world units, as a share of the smallest side b of the box, or in voxels (`0.5vox`,
// Volume::voxel()). As a criterion's limit it may be a ratio, with Unit::world.
struct Length {
  enum class Unit : std::uint8_t { world, box, voxel };
  double value = 0;
  Unit unit = Unit::world;

  // Returns the length in the scaled frame.
  double in(const Volume& volume) const;
};

// The test of Stage 1: the topological ball property, of regions of the exact contour (certified),
// or the paper's tests on Voronoi edges.
enum class RecoverWay : std::uint8_t { certified, paper };

struct Options : RunSettings {
  static constexpr double kNone = kNotAsked;

  RecoverWay recover = RecoverWay::certified;
  // Limits of Stage 2's criteria (surface/criteria.h). The limit of r/l holds in Stage 1 too.
  // Infinite: no limit.
  PerCriterion<Length> limits = usual_limits();
  Length r_min{0.25, Length::Unit::voxel};   // facets with r <= r_min violate no criterion but r/l
  double epsilon = 0.2;                      // Stage 1, paper's way: h/r; kNone: no ApproximateGeom
  Length fingers{0.4, Length::Unit::voxel};  // certified: largest distance from T to K

  // About how many voxels a block has along each axis; 0: the volume is one block. So it is with
  // the paper's Recover, with pole heights, and for an observer of insertions.
  static constexpr int kUsualSide = -1;  // usual_block_side() of blocks/grid.h
  int block_side = kUsualSide;

  CubicMethod cubic = CubicMethod::isolation;
  // The baseline of Table 2, the paper's way only: all refinement on the 3D triangulation.
  bool single_stage = false;
  bool stop_after_recover = false;
  bool cap = false;  // close the mesh on the box (cap/close_on_box.h)

  // Returns the published options: the paper's Recover, epsilon1 0.1, epsilon2 0.2, r_min 0.001 b.
  static Options paper();
  static PerCriterion<Length> usual_limits();
};

// Beyond these limits a run could not end in reasonable time (docs/proof.md, Theorem 5 and the
// table of options).
inline constexpr double kSmallestRMin = 0.001;          // voxels
inline constexpr std::size_t kMostSamples = 1'000'000;  // N0

// Throws InputError if an option is beyond these limits, a criterion's limit is below its least, or
// single_stage has RecoverWay::certified, which always has two stages.
void require_limits(const Options& options, const Volume& volume);

// Returns the options with all lengths in the scaled frame of the volume.
Parameters resolve(const Options& options, const Volume& volume);

}  // namespace deliso
