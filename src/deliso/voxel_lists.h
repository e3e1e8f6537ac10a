// SPDX-License-Identifier: MIT
// Lists of voxels by voxel_number(), ascending and without repeats: where Stage 1 splits T and
// where Stage 2 guards against crossings.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace deliso {

// Makes such a list of any.
inline void sort_out(std::vector<std::uint64_t>& voxels) {
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

inline std::vector<std::uint64_t> united(const std::vector<std::uint64_t>& a,
                                         const std::vector<std::uint64_t>& b) {
  std::vector<std::uint64_t> out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace deliso
