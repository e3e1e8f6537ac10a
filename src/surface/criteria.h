// SPDX-License-Identifier: MIT
// When a facet is to be refined: the conditions of paper §3.1 (ApproximateGeom) and §3.2
// (RefineGeom) as pure functions of measured numbers. All lengths in the scaled frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/triangle.h"
#include "surface/options.h"

namespace deliso {

struct Criteria {
  double h_over_r;      // epsilon in Stage 1, epsilon1 in Stage 2
  double r_over_pole;   // epsilon2; infinity where poles are not used
  double lambda;        // r/l
  double r_min;         // nothing smaller is refined
  double max_distance;  // h
  double max_radius;    // r
};

inline Criteria recover_criteria(const Options& o, double r_min) {
  const double infinity = std::numeric_limits<double>::infinity();
  return {o.epsilon, infinity, o.lambda, r_min, infinity, infinity};
}

inline Criteria refine_criteria(const Options& o, double r_min) {
  return {o.epsilon1, o.epsilon2, o.lambda, r_min, o.max_distance, o.max_radius};
}

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

// How much the worst of the conditions is passed; a facet is bad when it is over 1 and r > r_min.
// `pole` is the pole height h_sigma of the facet.
inline double violation(const FacetShape& s, double pole, const Criteria& k) {
  return std::max({s.h / (s.r * k.h_over_r), s.r / (pole * k.r_over_pole), s.r / (s.l * k.lambda),
                   s.h / k.max_distance, s.r / k.max_radius});
}

inline bool is_bad(const FacetShape& s, double pole, const Criteria& k) {
  return s.r > k.r_min && violation(s, pole, k) > 1;
}

}  // namespace deliso
