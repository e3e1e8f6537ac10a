// SPDX-License-Identifier: MIT
// Voxel-ray intersection (paper §4.2, after Parker et al. 1998): along a line the trilinear patch
// of a voxel is a cubic.
//
// The cubic is in Bernstein form, between the points where the line enters and leaves the voxel.
// Its coefficients are averages of the patch at corners of the box between these two points (the
// blossom of a multi-affine function). So only convex combinations of g - kappa at the corners are
// formed. That keeps the accuracy and makes two statements exact:
//   V1  If all corners lie on one side of kappa, so do all coefficients. The same holds for a
//       face's four corners at a point of that face.
//   V2  Where two voxels meet (L3 of lattice_line.h), both cubics have the same end value, bit by
//       bit.
// Hence, whatever the rounding, passages from inside (g >= kappa) to outside and back alternate
// along a line. A passage on a shared face is found in exactly one of the two voxels. The number of
// passages on a segment is odd exactly when its ends lie on different sides.
#pragma once

#include "isosurface/lattice_line.h"
#include "roots/cubic.h"
#include "volume/volume.h"

namespace deliso {

// Returns the Bernstein coefficients on [0, 1] of the patch on the segment from p to q (voxel
// coordinates in [0, 1]).
inline Cubic patch_along(const Corners& c, const Vec3& p, const Vec3& q) {
  // Values at x = p.x and x = q.x, side by side (which vectorizes).
  struct Pair {
    double p, q;
  };
  // Keeps V1: for 0 <= t <= 1 neither product changes its sign. Keeps V2: exact at t = 0 and 1.
  const auto mix = [](Pair a, Pair b, Pair t) {
    return Pair{(1 - t.p) * a.p + t.p * b.p, (1 - t.q) * a.q + t.q * b.q};
  };
  const auto mix_x = [&](std::size_t n) {
    return mix({c[n], c[n]}, {c[n + 1], c[n + 1]}, {p.x, q.x});
  };
  const Pair x00 = mix_x(0), x10 = mix_x(2), x01 = mix_x(4), x11 = mix_x(6);
  const Pair py{p.y, p.y}, qy{q.y, q.y}, pz{p.z, p.z}, qz{q.z, q.z};
  const Pair p0 = mix(x00, x10, py), p1 = mix(x01, x11, py);
  const Pair q0 = mix(x00, x10, qy), q1 = mix(x01, x11, qy);
  // Named by the points that gave y and z.
  const Pair pp = mix(p0, p1, pz), qp = mix(q0, q1, pz);
  const Pair pq = mix(p0, p1, qz), qq = mix(q0, q1, qz);
  constexpr double third = 1.0 / 3;
  return {pp.p, third * (pp.q + qp.p + pq.p), third * (qq.p + pq.q + qp.q), qq.q};
}

// Returns where the span passes through Sigma, as fractions of it, increasing: FindIntersections of
// Figure 12 for one voxel. `corners` holds g - kappa.
inline Roots find_intersections(const Corners& corners, const VoxelSpan& span, CubicMethod method) {
  return crossings(patch_along(corners, span.u0, span.u1), method);
}

// Returns the line's parameter at fraction s of the span.
inline double parameter_at(const VoxelSpan& span, double s) {
  return greater(smaller(span.t0 + s * (span.t1 - span.t0), span.t1), span.t0);
}

// Returns the point at fraction s (scaled frame), in the voxel. It comes from the voxel's own
// coordinates, not from the parameter, so that g stays at kappa even where t is large.
inline Vec3 point_at(const VoxelSpan& span, double s, const Volume& volume) {
  const Index3 voxel = volume.first() + span.voxel;
  const auto along = [s](int n, double u0, double u1) {
    return n + greater(smaller(u0 + s * (u1 - u0), 1.0), 0.0);
  };
  return volume.at_samples(Vec3{along(voxel.i, span.u0.x, span.u1.x),
                                along(voxel.j, span.u0.y, span.u1.y),
                                along(voxel.k, span.u0.z, span.u1.z)});
}

}  // namespace deliso
