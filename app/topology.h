// SPDX-License-Identifier: MIT
// The topology of a mesh and of the exact contour in reports, and the components of the contour by
// size: what --largest and --min-component would keep.
#pragma once

#include <string>
#include <string_view>

#include "app/report_writer.h"
#include "base/topology_counts.h"
#include "contour/contour.h"

namespace deliso {

std::string topology_text(const TopologyCounts& topology);
void add_topology(ReportWriter& out, std::string_view key, const TopologyCounts& topology,
                  std::string_view words);

// Returns the largest components, one a line, and the number of components by size. Empty if there
// are fewer than two. A component's share is that of the grid edges it crosses.
std::string components_text(const ContourSummary& surface);

// Adds a list "largest_components", at most a hundred, and a list "component_sizes".
void add_components(ReportWriter& out, const ContourSummary& surface);

}  // namespace deliso
