// SPDX-License-Identifier: MIT
// The parameters of the stages, with every length in the scaled frame. run/options.h has them as
// a user gives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/hardware_threads.h"
#include "base/topology_counts.h"
#include "run/criteria.h"

namespace deliso {

class Observer;

// Settings that options and parameters share.
struct RunSettings {
  ComponentChoice components;
  // The mesh is the same with any number.
  int threads = hardware_threads();
  std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
  // A progress bar or a trace (run/observer.h); may be null.
  Observer* observer = nullptr;
};

struct Parameters : RunSettings {
  double voxel;  // Grid::voxel()
  double r_min;
  double gap;  // facets that face each other are moved apart by so much, at least
  Criteria refinement;
  // Stage 2 leaves facets with a corner on a fixed arc as they are: blocks/seams.h refines them.
  bool leaves_seams = false;
};

}  // namespace deliso
