// SPDX-License-Identifier: MIT
#include "deliso/poles.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "delaunay/voronoi.h"

namespace deliso {

std::vector<double> compute_poles(const Triangulation& t, const Isosurface& surface) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::size_t count = t.vertex_capacity();
  std::vector<Vec3> gradient(count);
  for (VertexId q = 1; q < count; ++q) gradient[q] = surface.gradient(t.point(q));

  // Squared distance to the furthest Voronoi vertex, on the side of falling and of rising g.
  std::vector<std::array<double, 2>> furthest2(count, {0, 0});
  const auto see = [&](VertexId q, const Vec3& direction, double distance2) {
    double& side = furthest2[q][dot(direction, gradient[q]) > 0];
    side = std::max(side, distance2);
  };
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    if (!t.is_infinite(c)) {
      const Vec3 center = circumsphere(t, c).center;
      for (const VertexId q : t.vertices(c)) {
        const Vec3 direction = center - t.point(q);
        see(q, direction, length2(direction));
      }
      continue;
    }
    // A hull facet: the Voronoi cells of its vertices reach to infinity along its outward normal.
    for (int i = 0; i < 4; ++i) {
      if (t.vertex(c, i) != Triangulation::kInfinite) continue;
      const auto v = facet_vertices(t, {c, i});
      const Vec3 normal = area_normal(t.point(v[0]), t.point(v[1]), t.point(v[2]));
      const Facet inner = t.mirror({c, i});
      const Vec3 inward = t.point(t.vertex(inner.cell, inner.index)) - t.point(v[0]);
      const Vec3 outward = dot(normal, inward) > 0 ? -normal : normal;
      for (const VertexId q : v) see(q, outward, infinity);
    }
  }
  std::vector<double> height(count, infinity);
  for (VertexId q = 1; q < count; ++q) {
    height[q] = std::sqrt(std::min(furthest2[q][0], furthest2[q][1]));
  }
  return height;
}

}  // namespace deliso
