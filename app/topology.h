// SPDX-License-Identifier: MIT
// The topology of a mesh and of the exact contour in reports.
#pragma once

#include <string>
#include <string_view>

#include "app/json.h"
#include "base/topology_counts.h"

namespace deliso {

std::string topology_text(const TopologyCounts& topology);
void add_topology(JsonWriter& json, std::string_view key, const TopologyCounts& topology);

}  // namespace deliso
