// SPDX-License-Identifier: MIT
// What components a mesh or a contour has.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "check/check_mesh.h"
#include "contour/contour.h"

namespace deliso {

// (Euler number, boundary loops) of every component, sorted.
using ComponentKinds = std::vector<std::pair<std::int64_t, std::uint64_t>>;

inline ComponentKinds kinds_of(const TriMesh& mesh) {
  ComponentKinds kinds;
  for (const ComponentTopology& c : mesh_topology(mesh).components) {
    kinds.emplace_back(c.euler(), c.boundary_loops);
  }
  std::ranges::sort(kinds);
  return kinds;
}

inline ComponentKinds kinds_of(const ContourSummary& contour) {
  ComponentKinds kinds;
  for (const ContourComponent& c : contour.components)
    kinds.emplace_back(c.euler, c.boundary_loops);
  std::ranges::sort(kinds);
  return kinds;
}

}  // namespace deliso
