// SPDX-License-Identifier: MIT
// Boundary segments of the contour, linked into closed chains.
#pragma once

#include <vector>

#include "contour/contour.h"

namespace deliso {

// A segment of T on the box, directed as in its triangle.
struct BoundarySegment {
  VertexId from, to;
  std::uint32_t component;  // a label, later a component's number
  BoxFace face;
};

// Links segments into chains. pre: every vertex starts one segment and ends one; `component` holds
// component numbers.
BoundaryChains chain_segments(std::vector<BoundarySegment> segments);

}  // namespace deliso
