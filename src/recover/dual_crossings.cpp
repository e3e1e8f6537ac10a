// SPDX-License-Identifier: MIT
#include "recover/dual_crossings.h"

#include "base/parallel.h"
#include "delaunay/predicates.h"
#include "embedding/box_grid.h"
#include "embedding/triangle_pair.h"

namespace deliso {

std::vector<VertexId> between_crossings(const DualFacets& k, const Labels& labels, const Box3& box,
                                        int threads) {
  constexpr std::size_t kFacetsPerTask = 256;
  BoxGrid grid(box, fitting_cell(k.points, k.triangles));
  const auto is_flat = [&](const Triangle& t) {
    return collinear(k.points[t[0]], k.points[t[1]], k.points[t[2]]);
  };
  for (FaceId f = 0; f < k.triangles.size(); ++f) {
    if (!is_flat(k.triangles[f])) grid.add(f, grid.box_of(k.points, k.triangles[f]));
  }
  // Each pair is found once: from its new facet, or from the later one of two new facets.
  const auto add_crossings_of = [&](FaceId f, std::vector<VertexId>& found) {
    const Triangle& t = k.triangles[f];
    if (!k.is_new[f] || is_flat(t)) return;
    grid.any(grid.box_of(k.points, t), [&](FaceId g, const BoxGrid::Box&) {
      const bool is_mine = g < f || (g > f && !k.is_new[g]);
      if (!is_mine || !triangles_intersect(k.points, t, k.triangles[g])) return false;
      found.push_back(labels.furthest(k.t_triangles[g], labels.furthest(k.t_triangles[f])));
      return false;
    });
  };
  std::vector<std::vector<VertexId>> found(runs_of(k.triangles.size(), kFacetsPerTask));
  for_each_run(threads, k.triangles.size(), kFacetsPerTask,
               [&](std::size_t run, std::size_t f, std::size_t end) {
                 for (; f < end; ++f) add_crossings_of(FaceId(f), found[run]);
               });
  std::vector<VertexId> all;
  for (const std::vector<VertexId>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace deliso
