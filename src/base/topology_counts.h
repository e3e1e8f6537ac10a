// SPDX-License-Identifier: MIT
// The counts by which the topology of two surfaces is compared.
#pragma once

#include <cstdint>

namespace deliso {

struct TopologyCounts {
  std::uint64_t components = 0;
  std::int64_t euler = 0;
  std::uint64_t boundary_loops = 0;
  friend bool operator==(const TopologyCounts&, const TopologyCounts&) = default;
};

// Which components of Sigma are to be meshed.
struct ComponentChoice {
  double min_voxels = 0;    // those whose bounding box is smaller along every axis are not
  std::size_t largest = 0;  // only this many, those that cross the most grid edges; 0: all

  bool is_all() const { return min_voxels == 0 && largest == 0; }
};

}  // namespace deliso
