// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/box3.h"
#include "base/vec3.h"

namespace deliso {

// A point of a boundary loop, and the arc from it to the next.
struct LoopPoint {
  Vec3 point;
  BoxFace face;  // that has the arc
  // Every chain of mesh edges along the loop must have the point. There the curve turns on an edge
  // of the box, or a seam has a vertex.
  bool is_kept;
  bool is_fixed;  // of the arc: it lies on a seam (surface/boundary.h)

  friend bool operator==(const LoopPoint&, const LoopPoint&) = default;
};

// A closed curve in which Sigma meets the box, as a polygon of points of Sigma: the last point is
// joined to the first.
using BoundaryLoop = std::vector<LoopPoint>;
using BoundaryLoops = std::vector<BoundaryLoop>;

}  // namespace deliso
