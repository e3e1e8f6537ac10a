// SPDX-License-Identifier: MIT
// The distances between mesh and Sigma, in both directions, at points of each. Lengths in the
// scaled frame.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "check/triangle_tree.h"
#include "check/validity.h"
#include "isosurface/isosurface.h"
#include "run/criteria.h"

namespace deliso {

struct Distances {
  std::size_t points = 0;
  double max = 0, mean = 0, rms = 0;
  double quantile_999 = 0;    // 99.9 % of the points are no further
  Vec3 furthest;              // the point with `max`
  std::size_t not_found = 0;  // points left out: no point of Sigma on the lines searched
  std::size_t beyond = 0;     // points further than the bound
  // Of these, points further than r_min allows, and the furthest.
  std::size_t too_far = 0;
  double max_too_far = 0;
  Vec3 furthest_too_far;
  Vec3 first_not_found;
  std::size_t given_up = 0;  // points left out: too many triangles overlap there
};

// The bound on points. A point further than `distance` is allowed if it is within r_min of a
// triangle whose r is at most r_min.
struct DistanceBound {
  double distance = std::numeric_limits<double>::infinity();
  double r_min = 0;
};

// The length of a search for Sigma, in diagonals of a voxel.
inline constexpr double kSearchDiagonals = 4;

// Each triangle is measured at its middle, point 0, and at those of its edges.
using TriangleDistances = std::array<double, 4>;
Vec3 measured_point(const CleanMesh& mesh, std::size_t triangle, std::size_t point);

// Measures the distance to Sigma from these points, over at most `limit`. Searches along the
// gradient and along the triangle's normal. If that finds nothing within the bound and a voxel, or
// near by, also searches along the axes and towards the corners. The shortest of these is an upper
// bound of the distance. `of_triangles`, if given, receives all distances; infinite ones where
// nothing is found.
Distances distances_to_surface(const CleanMesh& mesh, const Isosurface& surface, double limit,
                               const DistanceBound& bound, int threads = 1,
                               std::vector<TriangleDistances>* of_triangles = nullptr);

// Measures the distance from every sample, a point of Sigma, to the nearest triangle of the mesh;
// empty without triangles. pre: the tree is that of the mesh.
Distances distances_from_surface(std::span<const Vec3> samples, const CleanMesh& mesh,
                                 const TriangleTree& tree, const DistanceBound& bound,
                                 int threads = 1);

// The edges of the mesh on the box, against the curves in which Sigma meets the box.
struct BoundaryDistances {
  std::size_t edges = 0;
  // The largest h. It runs from the middle of an edge to the curve, across the edge within its face
  // of the box.
  double max_h = 0;
  // Edges of r > r_min, half of their length, over a limit on h or h/r. Also those whose ball does
  // not meet the curve.
  std::size_t over_a_limit = 0;
};

// Measures the boundary. pre: `mesh` ends on the box only.
BoundaryDistances boundary_distances(const CleanMesh& mesh, const Isosurface& surface,
                                     const Criteria& limits);

// Returns 0 if p is on Sigma. That is so if a point of Sigma is within `tolerance` of p, on the
// lines through p along the gradient, the gradient in the box's faces at p, and the axes. It is
// also so if g is as near to kappa as at the oracle's own points (1e-9 of the range of the voxel's
// samples). Otherwise returns the distance to the nearest point of Sigma on these lines within
// `limit`, or `limit`. Lines of a point outside the box go through the nearest point of the box,
// and the way there counts.
double distance_off_surface(const Vec3& p, const Isosurface& surface, double tolerance,
                            double limit);

}  // namespace deliso
