// SPDX-License-Identifier: MIT
// Points to fill a solid with: corners and middles of the cubes of an octree, which where cubes are
// equal are a body-centered cubic lattice. Its tetrahedra are the best-shaped that fill space.
//
// The wanted length of an edge at x is the least, over points s of the surface, of their length
// plus growth * |x - s|, but at most max_edge.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace deliso {

// A point of the surface, and the length of edges there.
struct SizedPoint {
  Vec3 p;
  double length;
};

struct LatticeOptions {
  double growth = .35;
  double max_edge = std::numeric_limits<double>::infinity();
};

// Returns the points in a box around the surface, without those too near to it.
std::vector<Vec3> lattice_points(std::span<const SizedPoint> surface,
                                 const LatticeOptions& options);

}  // namespace deliso
