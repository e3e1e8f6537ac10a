// SPDX-License-Identifier: MIT
#include "contour/keep_components.h"

#include <algorithm>
#include <utility>

namespace deliso {
namespace {

// Returns the chains of kept components, with new numbers.
BoundaryChains kept_chains(const BoundaryChains& all, const std::vector<VertexId>& new_vertex,
                           const std::vector<std::uint32_t>& new_component) {
  BoundaryChains kept;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (new_component[all.component[c]] == kNoId) continue;
    for (std::size_t n = all.first[c]; n < all.first[c + 1]; ++n) {
      kept.vertices.push_back(new_vertex[all.vertices[n]]);
      kept.face.push_back(all.face[n]);
      kept.on_box_edge.push_back(all.on_box_edge[n]);
    }
    kept.first.push_back(static_cast<std::uint32_t>(kept.vertices.size()));
    kept.component.push_back(new_component[all.component[c]]);
  }
  return kept;
}

}  // namespace

void keep_components(ContourMesh& contour, std::span<const std::uint8_t> kept) {
  if (std::ranges::find(kept, 0) == kept.end()) return;
  std::vector<std::uint32_t> new_component(kept.size(), kNoId);
  std::vector<ContourComponent> components;
  for (std::uint32_t c = 0; c < kept.size(); ++c) {
    if (!kept[c]) continue;
    new_component[c] = static_cast<std::uint32_t>(components.size());
    components.push_back(contour.summary.components[c]);
  }
  contour.summary.components = std::move(components);

  std::vector<VertexId> new_vertex(contour.points.size(), kNoId);
  VertexId next = 0;
  for (VertexId v = 0; v < new_vertex.size(); ++v) {
    if (!kept[contour.component[v]]) continue;
    contour.points[next] = contour.points[v];
    contour.component[next] = new_component[contour.component[v]];
    contour.box_faces[next] = contour.box_faces[v];
    new_vertex[v] = next++;
  }
  contour.points.resize(next);
  contour.component.resize(next);
  contour.box_faces.resize(next);
  std::erase_if(contour.triangles, [&](std::array<VertexId, 3>& triangle) {
    for (VertexId& v : triangle) v = new_vertex[v];
    return triangle[0] == kNoId;
  });
  contour.crowded.clear();  // numbers of triangles
  contour.boundary = kept_chains(contour.boundary, new_vertex, new_component);
}

}  // namespace deliso
