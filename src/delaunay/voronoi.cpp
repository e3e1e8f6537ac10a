// SPDX-License-Identifier: MIT
#include "delaunay/voronoi.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/double_double.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// Relative to the numbers that they are computed from. A smaller squared sine or height has lost
// too many of its 53 bits for the promised accuracy.
constexpr double kMinSquaredSine = 1e-6;
constexpr double kMinHeight = 1e-6;
// As kMinHeight, for the 106 bits of a double-double.
constexpr double kMinDoubleDoubleHeight = 1e-22;

// Returns 2 det[u, v, w] times the circumcenter of 0, u, v, w.
template <class Vector>
Vector scaled_circumcenter(const Vector& u, const Vector& v, const Vector& w) {
  return dot(u, u) * cross(v, w) + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v);
}

// Returns det[b-a, c-a, d-a], given as a double-double, or exactly if that has no digit left.
double resolved_determinant(DoubleDouble det, double size, const Vec3& a, const Vec3& b,
                            const Vec3& c, const Vec3& d) {
  return std::fabs(det.high) > kMinDoubleDoubleHeight * size ? det.rounded()
                                                             : orient3d_value(a, b, c, d);
}

}  // namespace

FacetLine facet_line(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, n = cross(u, v);
  const double u2 = length2(u), v2 = length2(v), n2 = length2(n);
  if (n2 >= kMinSquaredSine * u2 * v2) {
    const Vec3 offset = (0.5 / n2) * (u2 * cross(v, n) + v2 * cross(n, u));
    return {a + offset, (1 / std::sqrt(n2)) * n, offset, length(offset)};
  }
  const auto du = DoubleDouble3::difference(b, a), dv = DoubleDouble3::difference(c, a);
  const auto dn = cross(du, dv);
  const Vec3 normal = dn.rounded();
  const Vec3 offset =
      (dot(du, du) * cross(dv, dn) + dot(dv, dv) * cross(dn, du)).rounded() / (2 * length2(normal));
  return {a + offset, normal / length(normal), offset, length(offset)};
}

double equidistant_parameter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                             const FacetLine& line) {
  // With w = d - a: |d-center|^2 - r^2 = w.(w - 2 offset), and n.(d-center) = n.w.
  // The numerator is rounded by about epsilon w (w + 2 r) <= epsilon (2 w^2 + r^2).
  const Vec3 w = d - a;
  const double height = dot(line.normal, w), w2 = length2(w);
  if (std::fabs(height) * line.radius >= kMinHeight * (2 * w2 + line.radius * line.radius))
    return dot(w, w - 2 * line.offset) / (2 * height);

  const auto du = DoubleDouble3::difference(b, a), dv = DoubleDouble3::difference(c, a),
             dw = DoubleDouble3::difference(d, a);
  const auto dn = cross(du, dv);
  const double area = length(dn.rounded());
  const double det = resolved_determinant(dot(dn, dw), area * std::sqrt(w2), a, b, c, d);
  return dot(dn, scaled_circumcenter(du, dv, dw)).rounded() / (2 * area * det);
}

FacetDual facet_dual(const Triangulation& t, Facet f) {
  const auto corner = [&](int k) { return t.vertex(f.cell, kFacetVertices[f.index][k]); };
  const SiteId x = corner(0), y = corner(1), z = corner(2);
  // Sorted by id. The normal, which points out of f.cell at first, is reversed if the number of
  // inversions is odd. (Ids have no order: branches of a sort would mispredict half of them.)
  const SiteId low = std::min(std::min(x, y), z), high = std::max(std::max(x, y), z);
  const SiteId middle(x ^ y ^ z ^ low ^ high);
  const bool outwards = !((x > y) ^ (y > z) ^ (x > z));
  const Vec3 &a = t.point(low), &b = t.point(middle), &c = t.point(high);
  const FacetLine line = facet_line(a, b, c);

  const auto end = [&](Facet g, double at_infinity) {
    const SiteId apex = t.vertex(g.cell, g.index);
    if (apex == Triangulation::kInfinite) return at_infinity;
    return equidistant_parameter(a, b, c, t.point(apex), line);
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Facet g = t.mirror(f);
  const double t_lo = end(outwards ? f : g, -kInfinity), t_hi = end(outwards ? g : f, kInfinity);
  // Exact ends never cross; rounded ones may, if the cells have (nearly) one circumsphere.
  return {line.center, line.normal, line.radius, std::min(t_lo, t_hi), std::max(t_lo, t_hi)};
}

Circumsphere circumsphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double det = dot(u, cross(v, w));
  const double size = length(u) * length(v) * length(w);
  if (std::fabs(det) >= kMinHeight * size) {
    const Vec3 offset = scaled_circumcenter(u, v, w) / (2 * det);
    return {a + offset, length(offset)};
  }
  const auto du = DoubleDouble3::difference(b, a), dv = DoubleDouble3::difference(c, a),
             dw = DoubleDouble3::difference(d, a);
  const double fine_det = resolved_determinant(dot(du, cross(dv, dw)), size, a, b, c, d);
  const Vec3 offset = scaled_circumcenter(du, dv, dw).rounded() / (2 * fine_det);
  return {a + offset, length(offset)};
}

Circumsphere circumsphere(const Triangulation& t, CellId c) {
  const auto& v = t.vertices(c);
  return circumsphere(t.point(v[0]), t.point(v[1]), t.point(v[2]), t.point(v[3]));
}

}  // namespace deliso
