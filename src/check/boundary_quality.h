// SPDX-License-Identifier: MIT
// The quality of a mesh along the box: its boundary edges against the curves in which Sigma meets
// the box, and the triangles at these edges.
#pragma once

#include <cstddef>
#include <limits>

#include "check/validity.h"
#include "isosurface/isosurface.h"
#include "surface/criteria.h"

namespace deliso {

struct BoundaryQuality {
  std::size_t edges = 0;
  // The distance h runs from the middle of an edge to the curve, across the edge within its face of
  // the box. Here r is half the edge, the radius of its ball. Edges with r > r_min are held to the
  // limits on h and h/r.
  double max_h = 0;
  double max_h_over_r = 0;
  std::size_t above_r_min = 0;
  std::size_t over_distance = 0, over_h_over_r = 0;  // of these
  std::size_t without_curve = 0;  // edges above r_min whose ball does not meet the curve there
  // The triangles with a boundary edge.
  std::size_t triangles = 0;
  std::size_t over_lambda = 0;             // of r/l, at any size
  std::size_t slivers = 0;                 // with an angle below kSliverDegrees
  double max_r_over_l = 0, min_angle = 0;  // degrees
};

inline constexpr double kSliverDegrees = 10;

// Measures the boundary. pre: `mesh` ends on the box only.
BoundaryQuality measure_boundary(const CleanMesh& mesh, const Isosurface& surface,
                                 const Criteria& limits);

}  // namespace deliso
