// SPDX-License-Identifier: MIT
// Exercise 8, an hour: which two corners does a face join?
//
// The exact contour meets the face of a voxel in two segments where its corners alternate: inside,
// outside, inside, outside. Either the two inside corners are joined or the two outside ones. On
// the face the samples are interpolated bilinearly, and the saddle decides: the asymptotic decider
// of Nielson and Hamann 1991. With the corners a, b on one diagonal and p, q on the other, each
// less kappa, the value at the saddle less kappa is
//   (a b - p q) / (a + b - p - q).
// A saddle at kappa counts as inside. Return true if the inside corners of face f are joined.
//
// Rounding must not decide, nor may the two voxels at the face disagree. `sign_of`
// (contour/exact_sign.h) returns the exact sign of a polynomial, of which it asks at some numbers:
//   sign_of(v, corners, [=](const auto& x) { return x.c(a) * x.c(b) - x.c(p) * x.c(q); })
// Here x.c(m) is the value of corner m less kappa, and `corners` has bit m set for each that is
// named. See `kFaceCorners` and `is_inside` in contour/voxel_topology.cpp, and the cube in its
// header.
//
// Hint: the corners of either diagonal may be inside. What is then the sign of the denominator?
bool inside_corners_joined(int mask, const VoxelValues& v, int f) {
  throw std::logic_error("exercise 8: your work");
}
