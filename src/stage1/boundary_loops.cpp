// SPDX-License-Identifier: MIT
#include "stage1/boundary_loops.h"

namespace deliso {

BoundaryLoops boundary_loops(const ContourMesh& contour) {
  const BoundaryChains& chains = contour.boundary;
  BoundaryLoops loops(chains.size());
  for (std::size_t c = 0; c < loops.size(); ++c) {
    for (std::uint32_t k = chains.first[c]; k < chains.first[c + 1]; ++k) {
      loops[c].points.push_back(contour.points[chains.vertices[k]]);
      loops[c].kept.push_back(chains.on_box_edge[k]);
      loops[c].faces.push_back(chains.face[k]);
    }
    loops[c].fixed.resize(loops[c].points.size(), 0);
  }
  return loops;
}

}  // namespace deliso
