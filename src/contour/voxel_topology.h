// SPDX-License-Identifier: MIT
// The topology of Sigma inside one voxel: the loops in which it meets the voxel's surface, and the
// two of them, if any, that bound one tube. All other loops bound disks.
//
// Numbering. At a corner stands its number, in the middle of an edge the edge's.
//
//        6-------3-------7
//       /|              /|
//      6 |             7 |
//     /  10           /  11        z
//    4-------2-------5   |         |  y
//    |   |           |   |         | /
//    |   2-------1---|---3         |/
//    8  /            9  /          +---- x
//    | 4             | 5
//    |/              |/
//    0-------0-------1
//
//    face     0         1         2         3          4         5
//    at       x = 0     x = 1     y = 0     y = 1      z = 0     z = 1
//    corners  0 4 6 2   1 3 7 5   0 1 5 4   2 6 7 3    0 2 3 1   4 5 7 6
//    edges    8 6 10 4  5 11 7 9  0 9 2 8   10 3 11 1  4 1 5 0   2 7 3 6
//
// Corner m is at (m & 1, m >> 1 & 1, m >> 2). Edges 0-3 run along x, at (y, z) = (e & 1,
// e >> 1 & 1); edges 4-7 along y, at (x, z); edges 8-11 along z, at (x, y). Faces are 2 * axis +
// side. Seen from outside, the corners around a face are counter-clockwise, and each edge follows
// its first corner. A mask has bit m set if corner m is inside (value - kappa >= 0).
//
// The faces. Two crossings are joined. Of four, the sign of the bilinear saddle decides. The two
// inside corners are joined exactly if the saddle's value is >= kappa: the product of the inside
// corners is at least that of the outside ones. That sign is exact (contour/exact_sign.h), so both
// voxels at a face agree.
//
// The interior. A slice across z is bilinear; where its four corners alternate, it has two arcs.
// Its topology changes only when a corner changes sign (at most four times), or when the saddle
// expression, a quadratic in z, does while they alternate (at most twice). The order of these
// events is exact too. Two columns may change sign at one height; then the one that becomes inside
// comes first. A saddle at kappa counts as inside. Both are as if kappa were a little lower, so
// that faces, sweep and samples equal to kappa follow one rule.
//
// The pieces. Loops that an arc connects between two events belong to one piece. A piece has at
// most two loops. With s <= 2 saddle events, V - E + F of the whole is (arcs at z = 0) + (arcs
// born) - s >= 0. Of three loops or more, two are triangles and bring an arc each.
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
  std::array<std::uint8_t, 12> edge{};              // crossed edges in order around the loops
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

// Returns the faces (bit f) whose four crossings need the saddle's sign.
std::uint8_t ambiguous_faces(int mask);

// Returns the loops for given decisions: bit f of `joined` is set if the inside corners of an
// ambiguous face f are joined. Loops run counter-clockwise seen from outside Sigma (value < kappa),
// as a boundary of their piece.
VoxelLoops trace_loops(int mask, std::uint8_t joined);

// Returns the loops of the voxel with these values; `mask` holds the signs above kappa.
VoxelLoops voxel_loops(int mask, const VoxelValues& values);

// Returns the tube, if there is one. pre: `loops` are those of the values.
Tube find_tube(int mask, const VoxelValues& values, const VoxelLoops& loops);

// Returns the mask of values minus kappa.
constexpr int mask_of(const Corners& c) {
  int mask = 0;
  for (int m = 0; m < 8; ++m) mask |= (c[m] >= 0) << m;
  return mask;
}

// Returns the two corners of an edge, the lower first.
constexpr std::array<int, 2> corners_of_edge(int e) {
  const int u = e & 1, v = e >> 1 & 1;
  if (e < 4) return {2 * u + 4 * v, 1 + 2 * u + 4 * v};
  if (e < 8) return {u + 4 * v, u + 2 + 4 * v};
  return {u + 2 * v, u + 2 * v + 4};
}

}  // namespace deliso
