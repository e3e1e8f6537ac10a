// SPDX-License-Identifier: MIT
// Measures of a triangle in space: the r, l and circumcenter of the paper's criteria (§3.1).
#pragma once

#include <algorithm>

#include "base/vec3.h"

namespace deliso {

// Returns the unit normal times twice the area. The corners run counter-clockwise as seen from
// where it points.
constexpr Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return cross(b - a, c - a);
}

// Returns six times the volume between the triangle and the origin, positive if its normal points
// away from there. The sum over a closed surface is positive if its normals point outwards. With an
// origin in all faces of the box that a surface meets, its open ends bound no volume.
constexpr double sixfold_volume(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a - origin, cross(b - origin, c - origin));
}

// Returns the circumcenter, in the triangle's plane; infinite or NaN for collinear corners.
inline Vec3 circumcenter(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, n = cross(u, v);
  return a + (length2(u) * cross(v, n) + length2(v) * cross(n, u)) / (2 * length2(n));
}

constexpr double shortest_edge2(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::min({distance2(a, b), distance2(b, c), distance2(c, a)});
}

// Returns the square of the circumradius over the shortest edge.
constexpr double radius_ratio2(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = distance2(a, b), y = distance2(b, c), z = distance2(c, a);
  const double longer = x <= y && x <= z ? y * z : y <= z ? x * z : x * y;
  return longer / (4 * length2(area_normal(a, b, c)));
}

constexpr double longest_edge2(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({distance2(a, b), distance2(b, c), distance2(c, a)});
}

// Returns the number of the corner with an angle of more than pi/2; 3: none has one.
constexpr int obtuse_corner(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  return dot(ca, ab) > 0 ? 0 : dot(ab, bc) > 0 ? 1 : dot(bc, ca) > 0 ? 2 : 3;
}

// Returns the square of the least height over the longest edge. Below kNeedleHeight squared a
// triangle is a needle: an angle is less than about .01 degree.
constexpr double height_ratio2(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest2 = longest_edge2(a, b, c);
  return length2(area_normal(a, b, c)) / (longest2 * longest2);
}
inline constexpr double kNeedleHeight = 2e-4;

// Returns the squared distance from p to the triangle. The nearest point is a corner or lies on an
// edge or inside, depending on which of the triangle's seven Voronoi regions holds p (Ericson 2005,
// §5.1.5).
inline double distance2_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return length2(ap);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return length2(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length2(ap - d1 / (d1 - d3) * ab);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return length2(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length2(ap - d2 / (d2 - d6) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return length2(bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
  }
  const double denominator = va + vb + vc;
  return length2(ap - vb / denominator * ab - vc / denominator * ac);
}

}  // namespace deliso
