// SPDX-License-Identifier: MIT
// What the stages are told: every length resolved, in the scaled frame. deliso/options.h has the
// same as a user gives it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/criteria.h"

namespace deliso {

// How far vertices are moved where they would touch, in voxels: well within what a vertex may be
// off Sigma.
inline constexpr double kHair = 1e-7;

class Observer;

struct Parameters {
  double voxel;  // the shortest side of one
  double r_min;
  double fingers;     // Stage 1, certified: how far a vertex of T may be from K
  Criteria recovery;  // ApproximateGeom, paper §3.1
  Criteria refinement;
  // Stage 2 as published: no dear rungs, no point of Sigma looked for, no crossing refused.
  bool as_published = false;

  int threads = 1;
  std::uint64_t seed = 1;
  std::size_t samples = 50;  // N0, random points to begin with
  double min_component = 0;  // components whose bounding box is smaller (voxels) are left out
  // Per component of T whether it is kept, where that is not for min_component to say: of what a
  // solid is to be closed from, no more is left out than contour/dissolve.h can do without.
  std::vector<std::uint8_t> kept;
  std::size_t target_vertices = std::numeric_limits<std::size_t>::max();
  std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
  // With max_vertices reached: keep the valid mesh so far (else an InputError is thrown).
  bool keep_partial = false;

  Observer* observer = nullptr;  // surface/observer.h; may be null

  bool asks_for_poles() const { return refinement.asks(Criterion::r_over_pole); }
};

}  // namespace deliso
