// SPDX-License-Identifier: MIT
#include "recover/dual_crossings.h"

#include <algorithm>

#include "delaunay/predicates.h"
#include "embedding/box_grid.h"
#include "embedding/triangle_pair.h"

namespace deliso {

std::vector<VertexId> between_crossings(const DualFacets& k, const Labels& labels,
                                        const Box3& box) {
  // All facets ask a grid of the new ones. If these are few, larger cells make that quicker.
  const auto count_new = static_cast<std::size_t>(std::ranges::count(k.is_new, 1));
  const double cells = 8 * count_new < k.triangles.size() ? 4 : 1;
  BoxGrid grid(box, cells * fitting_cell(k.points, k.triangles));
  grid.expect(count_new);
  const auto is_flat = [&](const Triangle& t) {
    return collinear(k.points[t[0]], k.points[t[1]], k.points[t[2]]);
  };
  for (FaceId f = 0; f < k.triangles.size(); ++f) {
    if (k.is_new[f] && !is_flat(k.triangles[f])) grid.add(f, grid.box_of(k.points, k.triangles[f]));
  }
  // Each pair is found once: from its old facet, or from the later one of two new facets.
  std::vector<VertexId> found;
  for (FaceId f = 0; f < k.triangles.size(); ++f) {
    const Triangle& t = k.triangles[f];
    if (is_flat(t)) continue;
    grid.any(grid.box_of(k.points, t), [&](FaceId g, const BoxGrid::Box&) {
      const bool is_mine = g < f || !k.is_new[f];
      if (!is_mine || !triangles_intersect(k.points, t, k.triangles[g])) return false;
      found.push_back(labels.furthest(k.t_triangles[g], labels.furthest(k.t_triangles[f])));
      return false;
    });
  }
  return found;
}

}  // namespace deliso
