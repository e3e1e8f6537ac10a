// SPDX-License-Identifier: MIT
#include "paper/orient.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/triangle.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

// The facet across an edge. `same_way`: both facets have the edge in the same direction, so their
// orientations differ.
struct Across {
  FaceId face = kNoId;
  bool same_way = false;
};

// Returns, per facet and corner, the facet across the opposite edge. `face` is kNoId unless the
// edge has exactly two facets.
std::vector<std::array<Across, 3>> across_edges(std::size_t vertices,
                                                std::span<const Triangle> facets) {
  std::vector<std::array<Across, 3>> across(facets.size());
  const std::vector<EdgeUse> uses = edge_uses(vertices, facets);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 2) {
      const bool same_way = edge[0].forward == edge[1].forward;
      across[edge[0].triangle][edge[0].side] = {edge[1].triangle, same_way};
      across[edge[1].triangle][edge[1].side] = {edge[0].triangle, same_way};
    }
    return true;
  });
  return across;
}

}  // namespace

void orient(SurfaceMesh& s, const Isosurface& surface) {
  std::vector<Triangle> facets = s.mesh.triangles();
  const auto across = across_edges(s.mesh.points.size(), facets);
  enum class State : std::uint8_t { unknown, kept, reversed };
  std::vector<State> state(facets.size(), State::unknown);
  const auto reverse = [&](FaceId f) { std::swap(facets[f][0], facets[f][1]); };
  std::vector<FaceId> component;
  for (FaceId start = 0; start < facets.size(); ++start) {
    if (state[start] != State::unknown) continue;
    state[start] = State::kept;
    component.assign(1, start);
    double along = 0;
    for (std::size_t next = 0; next < component.size(); ++next) {
      const FaceId f = component[next];
      const auto at = [&](std::size_t i) { return s.mesh.points[facets[f][i]]; };
      along += dot(area_normal(at(0), at(1), at(2)), surface.gradient(s.duals[f].center));
      for (const auto& [g, same_way] : across[f]) {
        if (g == kNoId || state[g] != State::unknown) continue;
        component.push_back(g);
        state[g] = (state[f] == State::reversed) != same_way ? State::reversed : State::kept;
        if (state[g] == State::reversed) reverse(g);
      }
    }
    if (along > 0) std::for_each(component.begin(), component.end(), reverse);
  }
  s.mesh = make_tri_mesh(std::move(s.mesh.points), facets);
}

}  // namespace deliso
