// SPDX-License-Identifier: MIT
// When a facet is to be refined: the conditions of paper §3.1 (ApproximateGeom) and §3.2
// (RefineGeom), and bounds on distance and size, as pure functions of measured numbers. All lengths
// in the scaled frame.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "surface/parameters.h"

namespace deliso {

// What a facet sigma with surface point x = V_sigma cap Sigma measures.
struct FacetShape {
  double r;  // circumradius
  double h;  // distance from the circumcenter to x
  double l;  // shortest edge
};

inline FacetShape measure(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 center = circumcenter(a, b, c);
  return {distance(center, a), distance(center, x), std::sqrt(shortest_edge2(a, b, c))};
}

// How much the worst of the conditions is passed, a facet is bad when it is over 1. `pole` is the
// pole height h_sigma of the facet.
inline double violation(const FacetShape& s, double pole, const Criteria& k) {
  double worst = 0;
  if (!(s.r <= k.shape_floor)) worst = s.r / (s.l * k.lambda);
  if (!(s.r <= k.r_min)) {
    worst = std::max({worst, s.h / (s.r * k.h_over_r), s.r / (pole * k.r_over_pole),
                      s.h / k.max_distance, s.r / k.max_radius});
  }
  return worst;
}

}  // namespace deliso
