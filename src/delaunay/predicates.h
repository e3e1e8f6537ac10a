// SPDX-License-Identifier: MIT
// The two questions a Delaunay triangulation asks of its points, answered without error.
//
//        d                 orient3d(a, b, c, d) > 0  iff  det[b-a, c-a, d-a] > 0, as here:
//        |  c              seen from d, the triangle a b c turns counter-clockwise.
//        | /
//        a --- b           insphere(a, b, c, d, e) > 0  iff  e lies strictly inside the sphere
//                          through a, b, c, d, where orient3d(a, b, c, d) > 0.
//
// Evaluation in layers, each entered only when the one before cannot tell (Shewchuk 1997): a
// filter with an error bound from the largest coordinate differences (inline, below), the same
// with Shewchuk's tighter "permanent", exact arithmetic on rounded differences, first-order
// corrections for that rounding, exact arithmetic on the coordinates.
//
// Guaranteed: the sign is right when every coordinate is 0 or has magnitude in
// [kSmallestCoordinate, kLargestCoordinate]. Then every coordinate is a multiple of 2^-192, every
// product of five coordinates or differences a multiple of 2^-960: nothing underflows, not even
// an error bound; and five factors below 2^201, times the 120 terms of a determinant, stay below
// 2^1023. Beyond that range, and for NaN and infinities, nothing is promised but a return value.
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

// Beyond the filter: never wrong, slower. Same arguments and signs as the functions below.
int orient3d_adaptive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int insphere_adaptive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

// Shewchuk's stage A bounds are (7 + 56 eps) eps and (16 + 224 eps) eps times the permanent (the
// determinant with every sign made plus). With mx, my, mz the largest differences per axis, the
// permanent of orient3d is at most 6 mx my mz, that of insphere 4 * 6 mx my mz (mx^2 + my^2 +
// mz^2); adding 1 to 7 * 6 and 16 * 24 covers the eps^2 and the rounding of the bound itself.
inline constexpr double kOrient3dFilter = 43 * kEpsilon;
inline constexpr double kInsphereFilter = 385 * kEpsilon;

}  // namespace predicates

// 1, 0 or -1: the sign of det[b-a, c-a, d-a].
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double det =
      u.z * (v.x * w.y - w.x * v.y) + v.z * (w.x * u.y - u.x * w.y) + w.z * (u.x * v.y - v.x * u.y);
  const auto largest = [](double p, double q, double r) {
    return std::max(std::max(std::fabs(p), std::fabs(q)), std::fabs(r));
  };
  const double bound = predicates::kOrient3dFilter * largest(u.x, v.x, w.x) *
                       largest(u.y, v.y, w.y) * largest(u.z, v.z, w.z);
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return predicates::orient3d_adaptive(a, b, c, d);
}

// 1, 0 or -1: e inside, on or outside the sphere through a, b, c, d.
// pre: orient3d(a, b, c, d) > 0 (when negative, the sign turns round).
inline int insphere(const Vec3& pa, const Vec3& pb, const Vec3& pc, const Vec3& pd,
                    const Vec3& pe) {
  const Vec3 a = pa - pe, b = pb - pe, c = pc - pe, d = pd - pe;
  const double ab = a.x * b.y - b.x * a.y, bc = b.x * c.y - c.x * b.y;
  const double cd = c.x * d.y - d.x * c.y, da = d.x * a.y - a.x * d.y;
  const double ac = a.x * c.y - c.x * a.y, bd = b.x * d.y - d.x * b.y;
  const double abc = a.z * bc - b.z * ac + c.z * ab, bcd = b.z * cd - c.z * bd + d.z * bc;
  const double cda = c.z * da + d.z * ac + a.z * cd, dab = d.z * ab + a.z * bd + b.z * da;
  const double det = (length2(a) * bcd - length2(b) * cda) + (length2(c) * dab - length2(d) * abc);
  const auto largest = [](double p, double q, double r, double s) {
    return std::max(std::max(std::fabs(p), std::fabs(q)), std::max(std::fabs(r), std::fabs(s)));
  };
  const double mx = largest(a.x, b.x, c.x, d.x), my = largest(a.y, b.y, c.y, d.y),
               mz = largest(a.z, b.z, c.z, d.z);
  const double bound = predicates::kInsphereFilter * mx * my * mz * (mx * mx + my * my + mz * mz);
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return predicates::insphere_adaptive(pa, pb, pc, pd, pe);
}

// Whether a, b, c lie on one line (or coincide). Exact; not for inner loops.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

// det[b-a, c-a, d-a], six times the volume, with a relative error of a few kEpsilon however flat
// the cell. Slow.
double orient3d_value(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace deliso
