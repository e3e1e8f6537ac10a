// SPDX-License-Identifier: MIT
// The topology of a mesh and of the exact contour in reports.
#pragma once

#include <string>
#include <string_view>

#include "app/report_writer.h"
#include "base/topology_counts.h"

namespace deliso {

std::string topology_text(const TopologyCounts& topology);
void add_topology(ReportWriter& out, std::string_view key, const TopologyCounts& topology,
                  std::string_view words);

}  // namespace deliso
