// SPDX-License-Identifier: MIT
// The two exact predicates of a Delaunay triangulation.
//
//        d                 orient3d(a, b, c, d) > 0  iff  det[b-a, c-a, d-a] > 0, as here:
//        |  c              seen from d, the triangle a b c turns counter-clockwise.
//        | /
//        a --- b           insphere(a, b, c, d, e) > 0  iff  e lies strictly inside the sphere
//                          through a, b, c, d, where orient3d(a, b, c, d) > 0.
//
// Evaluation in layers, each entered only if the one before cannot decide:
//   - doubles with an error bound from the largest coordinate differences (inline, below);
//   - doubles again, if differences have so few bits that nothing is rounded (points of grids);
//   - double-doubles with such a bound;
//   - exact expansions.
//
// Guarantee: the sign is right if every coordinate is 0 or has magnitude in [kSmallestCoordinate,
// kLargestCoordinate]. Then every coordinate is a multiple of 2^-192, and every product of five
// coordinates or differences a multiple of 2^-960. So nothing underflows, not even an error bound.
// Five factors below 2^201, times the 120 terms of a determinant, stay below 2^1023. Outside that
// range, and for NaN and infinities, only a return value is guaranteed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/vec3.h"

namespace deliso {

inline constexpr double kSmallestCoordinate = 0x1p-140;
inline constexpr double kLargestCoordinate = 0x1p+200;

// Largest relative error of one rounding: half the distance from 1 to the next double.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;

namespace predicates {

// Return the determinants, for vectors of doubles or of more precise numbers.
template <class Vector>
inline auto orient3d_determinant(const Vector& u, const Vector& v, const Vector& w) {
  return u.z * (v.x * w.y - w.x * v.y) + v.z * (w.x * u.y - u.x * w.y) +
         w.z * (u.x * v.y - v.x * u.y);
}

template <class Vector>
inline auto insphere_determinant(const Vector& a, const Vector& b, const Vector& c,
                                 const Vector& d) {
  const auto ab = a.x * b.y - b.x * a.y, bc = b.x * c.y - c.x * b.y;
  const auto cd = c.x * d.y - d.x * c.y, da = d.x * a.y - a.x * d.y;
  const auto ac = a.x * c.y - c.x * a.y, bd = b.x * d.y - d.x * b.y;
  const auto abc = a.z * bc - b.z * ac + c.z * ab, bcd = b.z * cd - c.z * bd + d.z * bc;
  const auto cda = c.z * da + d.z * ac + a.z * cd, dab = d.z * ab + a.z * bd + b.z * da;
  return (dot(a, a) * bcd - dot(b, b) * cda) + (dot(c, c) * dab - dot(d, d) * abc);
}

// Return bounds on a sixth of the permanent, the determinant with every sign made plus. A 3 x 3
// determinant has six terms, each at most the product of the largest differences per axis.
inline double largest(double p, double q, double r) {
  return std::max(std::max(std::fabs(p), std::fabs(q)), std::fabs(r));
}
inline double orient3d_scale(const Vec3& u, const Vec3& v, const Vec3& w) {
  return largest(u.x, v.x, w.x) * largest(u.y, v.y, w.y) * largest(u.z, v.z, w.z);
}
inline double insphere_scale(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double mx = std::max(largest(a.x, b.x, c.x), std::fabs(d.x));
  const double my = std::max(largest(a.y, b.y, c.y), std::fabs(d.y));
  const double mz = std::max(largest(a.z, b.z, c.z), std::fabs(d.z));
  return mx * my * mz * ((dot(a, a) + dot(b, b)) + (dot(c, c) + dot(d, d)));
}

// Shewchuk's error bounds for these determinants of rounded differences are (7 + 56 eps) eps and
// (16 + 224 eps) eps times the permanent. One more eps covers the eps^2 and the rounding here.
inline constexpr double kOrient3dFilter = (7 * 6 + 1) * kEpsilon;
inline constexpr double kInsphereFilter = (16 * 6 + 1) * kEpsilon;

// Behind the filter: never wrong, slower. Arguments and signs are those of the functions below.
int orient3d_adaptive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int insphere_adaptive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

}  // namespace predicates

// Returns the sign of det[b-a, c-a, d-a]: 1, 0 or -1.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double det = predicates::orient3d_determinant(u, v, w);
  const double bound = predicates::kOrient3dFilter * predicates::orient3d_scale(u, v, w);
  if (std::fabs(det) > bound) return (det > 0) - (det < 0);
  return predicates::orient3d_adaptive(a, b, c, d);
}

// Returns 1, 0 or -1 for e inside, on or outside the sphere through the other four points. pre:
// orient3d(a, b, c, d) > 0; if negative, the sign is reversed.
inline int insphere(const Vec3& pa, const Vec3& pb, const Vec3& pc, const Vec3& pd,
                    const Vec3& pe) {
  const Vec3 a = pa - pe, b = pb - pe, c = pc - pe, d = pd - pe;
  const double det = predicates::insphere_determinant(a, b, c, d);
  const double bound = predicates::kInsphereFilter * predicates::insphere_scale(a, b, c, d);
  if (std::fabs(det) > bound) return (det > 0) - (det < 0);
  return predicates::insphere_adaptive(pa, pb, pc, pd, pe);
}

// True if a, b, c lie on one line or coincide. Exact, behind a filter.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

// Returns det[b-a, c-a, d-a], six times the volume, with a relative error of a few kEpsilon however
// flat the cell. Slow.
double orient3d_value(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace deliso
