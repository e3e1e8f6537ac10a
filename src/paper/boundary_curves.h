// SPDX-License-Identifier: MIT
// The curves in which Sigma ends on the box (paper §5), by Marching Squares on its six faces.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box3.h"
#include "volume/volume.h"

namespace deliso::paper {

struct BoundaryCurves {
  // A piece of a curve within one square, on a face of the box; its ends by their numbers.
  struct Edge {
    std::uint32_t a, b;
    BoxFace face;
  };
  std::vector<Vec3> points;  // of Sigma: one on each grid edge of the box that it crosses
  std::vector<Edge> edges;
};

// Returns the curves. Where a square has four crossings, the sign of the saddle joins them
// (asymptotic decider, Nielson and Hamann 1991).
BoundaryCurves marching_squares(const Volume& volume, double kappa);

}  // namespace deliso::paper
