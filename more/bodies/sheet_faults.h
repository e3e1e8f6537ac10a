// SPDX-License-Identifier: MIT
// What is asked of changed sheets, once, in the end:
//   F1  No two facets cross, by exact predicates, and none is without an area.
//   F2  An edge has at most three facets. Around an edge of a curve the sheets follow each other as
//       their bodies say.
//   F3  Lines from a facet of each connected component meet the next facet in the body that they
//       left.
// With the topology, which no change alters, it follows that each region has its one body.
#pragma once

#include <vector>

#include "more/bodies/sheets.h"

namespace deliso {

// Returns the facets at fault. All facets that meet the box are there.
std::vector<FaceId> sheet_faults(const Sheets& sheets, const CutSheets& cut, const Box3& box);

}  // namespace deliso
