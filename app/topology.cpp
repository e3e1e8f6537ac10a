// SPDX-License-Identifier: MIT
#include "app/topology.h"

#include "app/text.h"

namespace deliso {

std::string topology_text(const TopologyCounts& topology) {
  return counted(topology.components, "component") + ", Euler number " +
         std::to_string(topology.euler) + ", " + counted(topology.boundary_loops, "boundary loop");
}

void add_topology(ReportWriter& out, std::string_view key, const TopologyCounts& topology,
                  std::string_view words) {
  out.open(key, words);
  out.add("components", topology.components, "connected ones");
  out.add("euler", topology.euler, "V - E + F of all components together");
  out.add("boundary_loops", topology.boundary_loops, "closed curves in which it ends");
  out.close();
}

}  // namespace deliso
