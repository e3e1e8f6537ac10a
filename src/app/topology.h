// SPDX-License-Identifier: MIT
// What a mesh and the exact contour are compared by.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/json.h"
#include "contour/contour.h"
#include "mesh/check_mesh.h"

namespace deliso {

struct Topology {
  std::uint64_t components = 0;
  std::int64_t euler = 0;
  std::uint64_t boundary_loops = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};

Topology topology_of(const ContourSummary& summary);
Topology topology_of(const MeshTopology& mesh);

std::string topology_text(const Topology& topology);
void add_topology(JsonWriter& json, std::string_view key, const Topology& topology);

}  // namespace deliso
