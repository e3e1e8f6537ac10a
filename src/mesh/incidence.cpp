// SPDX-License-Identifier: MIT
#include "mesh/incidence.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace deliso {
std::vector<EdgeUse> edge_uses(std::size_t vertices, std::span<const Triangle> triangles) {
  std::vector<std::size_t> next(vertices + 1, 0);
  const auto for_each_side = [&](auto&& visit) {
    for (FaceId n = 0; n < triangles.size(); ++n) {
      for (std::uint8_t i = 0; i < 3; ++i) {
        const VertexId from = triangles[n][(i + 1) % 3], to = triangles[n][(i + 2) % 3];
        visit(EdgeUse{std::min(from, to), std::max(from, to), n, i, from < to});
      }
    }
  };
  for_each_side([&](const EdgeUse& use) { ++next[use.lo + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<EdgeUse> uses(3 * triangles.size());
  for_each_side([&](const EdgeUse& use) { uses[next[use.lo]++] = use; });
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].lo == uses[i].lo) ++j;
    std::sort(uses.data() + i, uses.data() + j, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.hi, a.triangle, a.side) < std::tie(b.hi, b.triangle, b.side);
    });
  }
  return uses;
}

}  // namespace deliso
