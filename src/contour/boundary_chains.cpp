// SPDX-License-Identifier: MIT
#include "contour/boundary_chains.h"

#include <algorithm>

namespace deliso {

BoundaryChains chain_segments(std::vector<BoundarySegment> segments) {
  std::sort(segments.begin(), segments.end(),
            [](const auto& s, const auto& t) { return s.from < t.from; });
  const auto starting_at = [&](VertexId v) {
    const auto found = std::lower_bound(segments.begin(), segments.end(), v,
                                        [](const auto& s, VertexId id) { return s.from < id; });
    DELISO_CHECK(found != segments.end() && found->from == v);
    return static_cast<std::size_t>(found - segments.begin());
  };
  BoundaryChains chains;
  std::vector<bool> used(segments.size());
  for (std::size_t start = 0; start < segments.size(); ++start) {
    if (used[start]) continue;
    for (std::size_t s = start; !used[s]; s = starting_at(segments[s].to)) {
      used[s] = true;
      chains.vertices.push_back(segments[s].from);
      chains.face.push_back(segments[s].face);
    }
    BoxFace previous = chains.face.back();
    for (std::size_t n = chains.first.back(); n < chains.face.size(); ++n) {
      chains.on_box_edge.push_back(chains.face[n] != previous);
      previous = chains.face[n];
    }
    chains.first.push_back(static_cast<std::uint32_t>(chains.vertices.size()));
    chains.component.push_back(segments[start].component);
  }
  return chains;
}

}  // namespace deliso
