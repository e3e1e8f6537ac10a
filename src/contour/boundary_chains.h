// SPDX-License-Identifier: MIT
// Boundary segments of the contour, linked into closed chains.
#pragma once

#include <vector>

#include "contour/contour_stream.h"

namespace deliso {

// Links segments into chains. pre: every vertex starts one segment and ends one; `component` holds
// component numbers.
BoundaryChains chain_segments(std::vector<BoundarySegment> segments);

}  // namespace deliso
