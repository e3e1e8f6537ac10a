// SPDX-License-Identifier: MIT
// The components of a surface by size, as text and as JSON: what --largest and --min-component
// would keep.
#pragma once

#include <string>

#include "app/report_writer.h"
#include "contour/contour.h"

namespace deliso {

// Returns the largest components, one a line, and the number of components by size. Empty if there
// are fewer than two. A component's share is that of the grid edges it crosses.
std::string components_text(const ContourSummary& surface);

// Adds a list "largest_components", at most a hundred, and a list "component_sizes".
void add_components(ReportWriter& out, const ContourSummary& surface);

}  // namespace deliso
