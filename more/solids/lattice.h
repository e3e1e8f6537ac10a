// SPDX-License-Identifier: MIT
// Points to fill a solid with: corners and middles of the cubes of an octree, which where cubes are
// equal are a body-centered cubic lattice. Its tetrahedra are the best-shaped that fill space.
//
// Each corner and middle s of a wall has a length: the mean of the edges there. At x an edge should
// have the least of these lengths plus growth * |x - s|, but at most max_edge. Cubes outside are
// not divided by max_edge: the time goes with the points inside, and with the walls' area over the
// square of max_edge.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec3.h"
#include "more/solids/skin.h"

namespace deliso {

struct LatticeOptions {
  double growth = .35;
  double max_edge = std::numeric_limits<double>::infinity();
};

// Whether a point lies outside the solid.
using IsOutside = std::function<bool(const Vec3&)>;

// Returns the points inside, and others around, without those too near to the walls' corners and
// middles.
std::vector<Vec3> lattice_points(const IdArray<VertexId, Vec3>& points, std::span<const Wall> walls,
                                 const LatticeOptions& options, const IsOutside& is_outside);

}  // namespace deliso
