// SPDX-License-Identifier: MIT
// A vertex that the meshes of two or more blocks share (blocks/seam.h). All of them identify it by
// the edge of the volume's grid on which it lies.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "base/ids.h"

namespace deliso {

// The edge from sample `low` of the whole volume along `axis`. An edge has one vertex at most.
struct GridEdge {
  std::int32_t axis = 0;
  std::array<std::int32_t, 3> low{};
  friend bool operator==(const GridEdge&, const GridEdge&) = default;
  friend bool operator<(const GridEdge& a, const GridEdge& b) {
    return std::tie(a.axis, a.low) < std::tie(b.axis, b.low);
  }
};

struct SeamVertex {
  VertexId vertex = kNoId;
  GridEdge at;
};

// The names of these in PLY files, in this order, in an element `seam`.
inline constexpr std::array<const char*, 5> kSeamProperties{"vertex", "axis", "i", "j", "k"};

}  // namespace deliso
