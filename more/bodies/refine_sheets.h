// SPDX-License-Identifier: MIT
// Refines sheets one by one by Stage 2 (refine/refine.h), each towards the border of its two
// bodies. All other facets near it are frozen, and so is its boundary: curves are as coarsening
// left them. So gates G0 to G5 hold against all sheets.
#pragma once

#include <vector>

#include "more/bodies/coarsen_sheets.h"

namespace deliso {

// Refines the free facets in place; new points come last, and none outside the scope's box. Sheets
// on the box are flat, and stay. If the result has faults (more/bodies/sheet_faults.h) all stays,
// and is counted as unrefined.
void refine_sheets(Sheets& sheets, const SheetScope& scope, Report& report);

}  // namespace deliso
