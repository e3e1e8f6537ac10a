// SPDX-License-Identifier: MIT
// What the stages are told: every length resolved, in the scaled frame. deliso/options.h has the
// same as a user gives it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "base/topology_counts.h"
#include "surface/criteria.h"

namespace deliso {

class Observer;

// What a user says as the stages need it.
struct RunSettings {
  std::uint64_t seed = 1;
  std::size_t samples = 50;  // N0, random points to begin with
  ComponentChoice components;
  // How many to use; the mesh is the same with any number.
  int threads = hardware_threads();
  // The best mesh of about so many vertices: --max-distance gives way.
  std::size_t target_vertices = std::numeric_limits<std::size_t>::max();
  std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
  // With max_vertices reached: keep the valid mesh so far (else an InputError is thrown).
  bool keep_partial = false;
  // Is told what the run does (surface/observer.h): a progress bar, a trace, a profile; may be
  // null.
  Observer* observer = nullptr;
};

struct Parameters : RunSettings {
  double voxel;  // the shortest side of one
  double r_min;
  double fingers;     // Stage 1, certified: how far a vertex of T may be from K
  Criteria recovery;  // ApproximateGeom, paper §3.1
  Criteria refinement;
  // Stage 2 as published: no dear rungs, no point of Sigma looked for, no crossing refused.
  bool as_published = false;

  // Per component of T whether it is kept, where that is not for `components` to say: of what a
  // solid is to be closed from, no more is left out than contour/dissolve.h can do without.
  std::vector<std::uint8_t> kept;

  bool asks_for_poles() const { return refinement.asks(Criterion::r_over_pole); }
};

}  // namespace deliso
