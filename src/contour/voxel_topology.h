// SPDX-License-Identifier: MIT
// What Sigma looks like inside one voxel, combinatorially: the loops in which it meets the voxel's
// surface, and which two of them, if any, bound one tube. All other loops bound disks.
//
// Numbering. Corner m is at (m & 1, m >> 1 & 1, m >> 2). Edges 0-3 run along x, at (y, z) =
// (e & 1, e >> 1 & 1); edges 4-7 along y, at (x, z); edges 8-11 along z, at (x, y). Face 2 * axis +
// side. A mask has bit m set where corner m is inside (value - kappa >= 0).
//
// The faces. Two crossings are joined. Of four, by the sign of the bilinear saddle: the two inside
// corners are joined exactly when the saddle's value is >= kappa, that is when the product of the
// inside corners is at least that of the outside ones. That sign is exact (contour/exact_sign.h),
// so both voxels at a face agree.
//
// The interior. A slice across z is bilinear, with two arcs where its four corners alternate and
// its topology changes only when a corner changes sign (at most four times) or, while they
// alternate, when the saddle expression, a quadratic in z, does (at most twice). The order of these
// events is exact as well. Where two columns change sign at one height, the one that gets inside
// comes first, and a saddle at kappa counts as inside: all as if kappa were a little lower, so that
// faces, sweep and samples equal to kappa follow one rule. Loops that an arc
// between two events connects belong to one piece. A piece has at most two loops: with s <= 2
// saddle events, V - E + F of the whole is (arcs at z = 0) + (arcs born) - s >= 0, and wherever
// there are three loops or more, two of them are triangles and bring an arc each.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "contour/exact_sign.h"
#include "volume/volume.h"

namespace deliso {

inline constexpr int kMaxLoops = 4;

struct VoxelLoops {
  int count = 0;
  std::array<std::uint8_t, kMaxLoops + 1> first{};  // loop l is edge[first[l] .. first[l + 1])
  std::array<std::uint8_t, 12> edge{};              // crossed edges in order round the loops
  std::array<std::uint8_t, 12> face{};              // the face of the segment to the next crossing

  std::span<const std::uint8_t> edges(int loop) const {
    return std::span(edge).subspan(first[loop], first[loop + 1] - first[loop]);
  }
};

// Two loops that bound one tube; none when a == b.
struct Tube {
  int a = 0, b = 0;
  explicit operator bool() const { return a != b; }
};

// Faces (bit f) whose four crossings need the saddle's sign.
std::uint8_t ambiguous_faces(int mask);

// The loops for given decisions: bit f of `joined` set where the inside corners of an ambiguous
// face f are joined. Loops run counter-clockwise seen from outside Sigma (value < kappa), as a
// boundary of the piece they bound.
VoxelLoops trace_loops(int mask, std::uint8_t joined);

// The loops of the voxel with these values; `mask` are the signs above kappa. The reference is to a
// table or to `scratch`.
const VoxelLoops& voxel_loops(int mask, const VoxelValues& values, VoxelLoops& scratch);

// Whether the saddle of an ambiguous face is at kappa, to the last bits: there two arcs of Sigma on
// the face meet in a point, and across the face Sigma is no surface.
bool has_tied_saddle(int mask, const Corners& c);

// pre: loops are those of the values.
Tube find_tube(int mask, const VoxelValues& values, const VoxelLoops& loops);

// The mask of values minus kappa.
constexpr int mask_of(const Corners& c) {
  int mask = 0;
  for (int m = 0; m < 8; ++m) mask |= (c[m] >= 0) << m;
  return mask;
}

// The two corners of an edge, the lower first.
constexpr std::array<int, 2> corners_of_edge(int e) {
  const int u = e & 1, v = e >> 1 & 1;
  if (e < 4) return {2 * u + 4 * v, 1 + 2 * u + 4 * v};
  if (e < 8) return {u + 4 * v, u + 2 + 4 * v};
  return {u + 2 * v, u + 2 * v + 4};
}

}  // namespace deliso
