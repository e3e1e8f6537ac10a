// SPDX-License-Identifier: MIT
#include "app/topology.h"

#include "app/text.h"

namespace deliso {

std::string topology_text(const TopologyCounts& topology) {
  return counted(topology.components, "component", "components") + ", Euler number " +
         std::to_string(topology.euler) + ", " +
         counted(topology.boundary_loops, "boundary loop", "boundary loops");
}

void add_topology(JsonWriter& json, std::string_view key, const TopologyCounts& topology) {
  json.open(key);
  json.add("components", topology.components);
  json.add("euler", topology.euler);
  json.add("boundary_loops", topology.boundary_loops);
  json.close();
}

}  // namespace deliso
