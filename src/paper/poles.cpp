// SPDX-License-Identifier: MIT
#include "paper/poles.h"

#include <algorithm>
#include <array>

#include "delaunay/voronoi.h"

namespace deliso::paper {

std::vector<double> compute_poles(const Triangulation& del, const Sigma& sigma) {
  const Volume& volume = sigma.volume();
  const Box3 box = volume.box();
  const auto is_inside = [&](const Vec3& p) { return volume.value(p) >= sigma.kappa(); };
  std::vector<std::array<double, 2>> furthest(del.vertex_capacity(), {0, 0});
  for (CellId c = 0; c < del.cell_capacity(); ++c) {
    if (!del.is_live(c) || del.is_infinite(c)) continue;
    const Vec3 center = circumsphere(del, c).center;
    const bool is_in_box = distance2_to(box, center) == 0;
    const bool inside = is_in_box && is_inside(center);
    for (const SiteId q : del.vertices(c)) {
      const Vec3& from = del.point(q);
      const Vec3 along = center - from;
      double& h =
          furthest[q][is_in_box ? inside
                                : is_inside(from + clip(from, along, {0, 1}, box).hi * along)];
      h = std::max(h, length(along));
    }
  }
  std::vector<double> heights;
  heights.reserve(furthest.size());
  for (const auto& [outside, inside] : furthest) heights.push_back(std::min(outside, inside));
  return heights;
}

}  // namespace deliso::paper
