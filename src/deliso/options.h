// SPDX-License-Identifier: MIT
// What a run can be told, as a user says it: the paper's parameters (§3.1, §3.2), and ours.
#pragma once

#include <cstddef>
#include <cstdint>

#include "roots/cubic.h"
#include "surface/parameters.h"
#include "volume/volume.h"

namespace deliso {

// A length in world units (or, as a criterion's limit, a plain number), as a share of b, the
// smallest side of the box, or in voxels (`0.5vox`, of the shortest side of one).
struct Length {
  enum class Unit : std::uint8_t { world, box, voxel };
  double value = 0;
  Unit unit = Unit::world;

  // In the scaled frame.
  double in(const Volume& volume) const;
};

// How Stage 1 knows that it is done: by the closed-ball conditions on the exact contour, or by the
// paper's tests on Voronoi edges.
enum class RecoverWay : std::uint8_t { certified, paper };

struct Options : RunSettings {
  static constexpr double kNone = kNotAsked;

  RecoverWay recover = RecoverWay::certified;
  // Stage 2's criteria (surface/criteria.h); that on r/l is Stage 1's too. Infinite: not asked.
  PerCriterion<Length> limits = usual_limits();
  Length r_min{0.5, Length::Unit::voxel};    // nothing with r <= r_min is refined for geometry
  double epsilon = 0.2;                      // Stage 1, paper's way: h/r; kNone: no ApproximateGeom
  Length fingers{0.4, Length::Unit::voxel};  // certified: how far Sigma may be from Stage 1's mesh

  CubicMethod cubic = CubicMethod::isolation;
  // Table 2's baseline, the paper's way only: all refinement on the 3D triangulation.
  bool single_stage = false;
  bool stop_after_recover = false;
  bool cap = false;  // close the mesh on the box (cap/close_on_box.h)

  // Everything as published: the paper's Recover, epsilon1 0.1, epsilon2 0.2, r_min = 0.001 b.
  static Options paper();
  static PerCriterion<Length> usual_limits();
};

// Limits of what is taken on: beyond them a run could not end in reasonable time
// (docs/proof.md, Theorem 5 and the table of options).
inline constexpr double kSmallestRMin = 0.001;          // voxels
inline constexpr std::size_t kMostSamples = 1'000'000;  // N0

// Throws InputError for options beyond these limits, for a criterion's limit below its least, and
// for single_stage with RecoverWay::certified, which always has two.
void require_limits(const Options& options, const Volume& volume);

// All lengths in the scaled frame of the volume.
Parameters resolve(const Options& options, const Volume& volume);

}  // namespace deliso
