// SPDX-License-Identifier: MIT
// Voxel-ray intersection (paper §4.2, after Parker et al. 1998): along a line the trilinear patch
// of a voxel is a cubic.
//
// The cubic is built between the two points where the line enters and leaves the voxel, in
// Bernstein form: its coefficients are averages of the patch at corners of the box these points
// span (the blossom of a multi-affine function). So nothing but convex combinations of g - kappa at
// the corners is ever formed, which keeps the accuracy and makes two things exact:
//   V1  when all corners lie on one side of kappa, so do all coefficients; the same goes for a
//       face's four corners at a point of that face;
//   V2  where two voxels meet (L3 of lattice_line.h), both cubics have the same end value, bit by
//       bit.
// Hence along a line the passages from inside (g >= kappa) to outside and back alternate, whatever
// is rounded: one on a shared face is found in exactly one of the two voxels, and the number of
// passages on a segment is odd exactly when its ends lie on different sides.
#pragma once

#include "kdtree/lattice_line.h"
#include "roots/cubic.h"
#include "volume/volume.h"

namespace deliso {

// g - kappa at the corners, numbered as in Corners, of the voxel whose first sample is *s.
template <class T>
Corners corners_from(const T* s, std::size_t dy, std::size_t dz, double kappa) {
  return {static_cast<double>(s[0]) - kappa,       static_cast<double>(s[1]) - kappa,
          static_cast<double>(s[dy]) - kappa,      static_cast<double>(s[dy + 1]) - kappa,
          static_cast<double>(s[dz]) - kappa,      static_cast<double>(s[dz + 1]) - kappa,
          static_cast<double>(s[dz + dy]) - kappa, static_cast<double>(s[dz + dy + 1]) - kappa};
}

// Bernstein coefficients on [0, 1] of the patch along the straight way from p to q (voxel
// coordinates in [0, 1]).
inline Cubic patch_along(const Corners& c, const Vec3& p, const Vec3& q) {
  // Keeps V1: with 0 <= t <= 1 neither product changes its sign; and V2: exact at t = 0 and 1.
  const auto mix = [](double a, double b, double t) { return (1 - t) * a + t * b; };
  std::array<double, 4> px, qx;  // g at p.x, q.x on the edges along x
  for (std::size_t n = 0; n < 4; ++n) {
    px[n] = mix(c[2 * n], c[2 * n + 1], p.x);
    qx[n] = mix(c[2 * n], c[2 * n + 1], q.x);
  }
  std::array<double, 2> pp, pq, qp, qq;  // named by the points that gave x and y
  for (std::size_t n = 0; n < 2; ++n) {
    pp[n] = mix(px[2 * n], px[2 * n + 1], p.y);
    pq[n] = mix(px[2 * n], px[2 * n + 1], q.y);
    qp[n] = mix(qx[2 * n], qx[2 * n + 1], p.y);
    qq[n] = mix(qx[2 * n], qx[2 * n + 1], q.y);
  }
  constexpr double third = 1.0 / 3;
  return {mix(pp[0], pp[1], p.z),
          third * (mix(qp[0], qp[1], p.z) + mix(pq[0], pq[1], p.z) + mix(pp[0], pp[1], q.z)),
          third * (mix(pq[0], pq[1], q.z) + mix(qp[0], qp[1], q.z) + mix(qq[0], qq[1], p.z)),
          mix(qq[0], qq[1], q.z)};
}

// FindIntersections of Figure 12, for one voxel: where the span passes through Sigma, as fractions
// of it, increasing. `corners` holds g - kappa.
inline Roots find_intersections(const Corners& corners, const VoxelSpan& span, CubicMethod method) {
  return crossings(patch_along(corners, span.u0, span.u1), method);
}

// The line's parameter and the point (scaled frame, within the voxel) at fraction s of the span.
double parameter_at(const VoxelSpan& span, double s);
Vec3 point_at(const VoxelSpan& span, double s, const Vec3& spacing);

}  // namespace deliso
