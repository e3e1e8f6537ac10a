// SPDX-License-Identifier: MIT
#include "paper/poles.h"

#include <algorithm>
#include <array>

#include "delaunay/voronoi.h"

namespace deliso::paper {

std::vector<std::array<double, 2>> both_poles(const Triangulation& del, const Sigma& sigma) {
  std::vector<std::array<double, 2>> furthest(del.vertex_capacity(), {0, 0});
  for (CellId c = 0; c < del.cell_capacity(); ++c) {
    if (!del.is_live(c) || del.is_infinite(c)) continue;
    const Circumsphere sphere = circumsphere(del, c);
    const bool is_inside = sigma.volume().value(sphere.center) >= sigma.kappa();
    for (const SiteId q : del.vertices(c)) {
      furthest[q][is_inside] = std::max(furthest[q][is_inside], sphere.radius);
    }
  }
  return furthest;
}

std::vector<double> compute_poles(const Triangulation& del, const Sigma& sigma) {
  std::vector<double> heights;
  for (const auto& [outside, inside] : both_poles(del, sigma)) {
    heights.push_back(std::min(outside, inside));
  }
  return heights;
}

}  // namespace deliso::paper
