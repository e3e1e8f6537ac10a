// SPDX-License-Identifier: MIT
// What a facet must meet that replaces others: a good shape, and Sigma near. Two values of the
// interpolant say that Sigma, facing as the facet does, passes within the bound of its
// circumcenter; a surface point costs ten times as much. Two more say that no other sheet comes
// between the circumcenter and the ends of its ball: the vertices of that sheet would be in the
// ball, and the facet not Delaunay.
// A bound beyond the ball is not asked there. What lies outside the ball may be the next sheet,
// and the values would refuse the more, the larger the bound.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "run/parameters.h"
#include "volume/interpolant.h"

namespace deliso {

struct FacetTest {
  FacetTest(const Volume& volume, double kappa, const Parameters& p, double distance)
      : g(volume, kappa),
        bound(distance),
        least_reach(kLeastReachVoxels * p.voxel),
        r_min2(p.r_min * p.r_min) {
    const double ratio = p.refinement[Criterion::r_over_l];
    ratio2 = ratio * ratio;
  }

  Interpolant g;
  double bound;        // on the distance
  double least_reach;  // kLeastReachVoxels as a length
  double r_min2;       // a smaller facet may be at any distance
  double ratio2;       // limit of (r/l)^2

  // The squares of r and of the shortest edge.
  struct Shape {
    double r2, shortest2;
    bool is_within(double limit2) const { return r2 <= limit2 * shortest2; }
  };

  // Edge vectors of a facet, and their products.
  struct Facet {
    Facet(const Vec3& a, const Vec3& b, const Vec3& c)
        : from(a),
          u(b - a),
          v(c - a),
          normal(cross(u, v)),
          u2(length2(u)),
          v2(length2(v)),
          w2(length2(c - b)),
          normal2(length2(normal)) {}

    Shape shape() const { return {u2 * v2 * w2 / (4 * normal2), std::min({u2, v2, w2})}; }

    Vec3 from, u, v, normal;
    double u2, v2, w2, normal2;
  };

  // How far from the circumcenter no other sheet may come, in circumradii. With 0 BABY has 1.7 % of
  // facets that are not restricted Delaunay, with this .7 %; with 1.2 it has 5 % more vertices.
  static constexpr double kBall = 0.9;

  // Bounds up to this are asked as they are, beyond the ball of a small facet too. With 0 TOOTH has
  // up to 3 % fewer vertices, but 6 samples too far from the mesh at D = .5 voxel.
  static constexpr double kLeastReachVoxels = 0.5;

  bool has_surface_near(const Facet& f, double r2) const {
    if (r2 <= r_min2) return true;
    const double uv = dot(f.u, f.v), half = 0.5 / f.normal2;
    const Vec3 center = f.from + half * f.v2 * (f.u2 - uv) * f.u + half * f.u2 * (f.v2 - uv) * f.v;
    const double size = std::sqrt(f.normal2), ball = kBall * std::sqrt(r2 / f.normal2);
    const double step = std::min(bound / size, std::max(least_reach / size, ball));
    const auto values = g.on_line(center, f.normal, {-step, step, -ball, ball});
    return values[0] >= 0 && values[1] < 0 && values[2] >= 0 && values[3] < 0;
  }

  // True if the facet faces along, has an r/l within the limit or `worst2`, and Sigma near.
  bool holds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& along, double worst2) const {
    const Facet f(a, b, c);
    if (!(dot(f.normal, along) > 0)) return false;
    const Shape shape = f.shape();
    return shape.is_within(std::max(ratio2, worst2)) && has_surface_near(f, shape.r2);
  }

  // True if the angles at a and d, across the edge of abc and dcb, sum to more than pi, and the
  // facets after its flip hold.
  bool asks_flip(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
    const double at_a = dot(b - a, c - a), at_d = dot(b - d, c - d);
    const Vec3 n = area_normal(a, b, c), m = area_normal(d, c, b);
    if (at_a * length(m) + at_d * length(n) >= 0) return false;
    const double worst2 = std::max(radius_ratio2(a, b, c), radius_ratio2(d, c, b));
    return holds(a, b, d, n + m, worst2) && holds(d, c, a, n + m, worst2);
  }
};

}  // namespace deliso
