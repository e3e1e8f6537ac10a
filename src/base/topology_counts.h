// SPDX-License-Identifier: MIT
// What surfaces are compared by.
#pragma once

#include <cstdint>

namespace deliso {

struct TopologyCounts {
  std::uint64_t components = 0;
  std::int64_t euler = 0;
  std::uint64_t boundary_loops = 0;
  friend bool operator==(const TopologyCounts&, const TopologyCounts&) = default;
};

}  // namespace deliso
