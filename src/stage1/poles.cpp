// SPDX-License-Identifier: MIT
#include "stage1/poles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/stopwatch.h"
#include "delaunay/voronoi.h"
#include "surface/observer.h"

namespace deliso {

std::vector<double> compute_poles(const Triangulation& t, const Isosurface& surface,
                                  const Parameters& parameters, Report& report) {
  if (!parameters.asks_for_poles()) return {};
  begin_stage(parameters.observer, "poles");
  const StepTimer timer(report.seconds_poles);
  const std::size_t count = t.vertex_capacity();
  std::vector<Vec3> gradient(count);
  for (SiteId q = 1; q < count; ++q) gradient[q] = surface.gradient(t.point(q));

  // Squared distances to the poles on the sides of falling and of rising g.
  std::vector<std::array<double, 2>> furthest2(count, {0, 0});
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c) || t.is_infinite(c)) continue;
    const Vec3 center = circumsphere(t, c).center;
    for (const SiteId q : t.vertices(c)) {
      const Vec3 direction = center - t.point(q);
      double& furthest = furthest2[q][dot(direction, gradient[q]) > 0];
      furthest = std::max(furthest, length2(direction));
    }
  }
  std::vector<double> height(count);
  for (SiteId q = 0; q < count; ++q) {
    height[q] = std::sqrt(std::min(furthest2[q][0], furthest2[q][1]));
  }
  return height;
}

}  // namespace deliso
