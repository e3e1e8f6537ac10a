// SPDX-License-Identifier: MIT
// Pole heights (paper §2.2.1 and §3.2), after Amenta and Bern 1999: h_q is the distance from q to
// the furthest Voronoi vertex of V_q on the nearer of the surface's two sides.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"

namespace deliso {

// One height per vertex id. A side is told by the gradient at q; where V_q is unbounded on a side
// that side's pole is infinitely far, and h_q is the other's; infinite when both are.
std::vector<double> compute_poles(const Triangulation& triangulation, const Isosurface& surface);

// The mean over those heights that are finite; infinite when none is. h_sigma of a facet is that of
// its vertices; a new vertex takes that of its neighbours.
class PoleMean {
 public:
  void add(double height) {
    if (height == std::numeric_limits<double>::infinity()) return;
    sum_ += height;
    ++count_;
  }
  double value() const {
    return count_ > 0 ? sum_ / count_ : std::numeric_limits<double>::infinity();
  }

 private:
  double sum_ = 0;
  int count_ = 0;
};

inline double facet_pole(std::span<const double> poles, const std::array<VertexId, 3>& v) {
  PoleMean mean;
  for (const VertexId q : v) mean.add(poles[q]);
  return mean.value();
}

}  // namespace deliso
