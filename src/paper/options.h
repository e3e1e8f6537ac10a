// SPDX-License-Identifier: MIT
// What a run is given: the published parameters (§3.1, §3.2), and the few that the paper leaves to
// whoever runs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "roots/cubic.h"

namespace deliso::paper {

class Observer;

struct Options {
  double epsilon = 0.2;   // Recover: largest h/r
  double epsilon1 = 0.1;  // Refine: largest h/r
  double epsilon2 = 0.2;  // Refine: largest r over pole height
  double lambda = 2;      // both: largest r/l
  double r_min = 0.001;  // both: facets of r up to this are not refined; in b, the box's least side
  std::size_t lines = 50;  // random lines; where they meet Sigma, S_0 has its points
  std::uint64_t seed = 1;
  CubicMethod solver = CubicMethod::schwarze;
  // Voronoi facets are tested, too, and the sample meets every component (facet_cycles.h).
  bool facet_cycles = false;
  bool stop_after_recover = false;  // the mesh is Del S_1|Sigma
  std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
  Observer* observer = nullptr;

  // In r_min: nearer points of Sigma are taken for one. The least power of ten with which insertion
  // ends on all volumes.
  static constexpr double kClosest = 0.1;
};

}  // namespace deliso::paper
