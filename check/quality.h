// SPDX-License-Identifier: MIT
// The shapes of a mesh's triangles in one summary. Here r is a triangle's circumradius, l its
// shortest edge (paper §3.1). If r/l <= lambda, no angle is below asin(1 / (2 lambda)).
#pragma once

#include <array>
#include <cstddef>

#include "mesh/tri_mesh.h"

namespace deliso {

struct MeshQuality {
  static constexpr std::array kQuantiles{0.25, 0.5, 0.75, 0.9, 0.99, 1.0};
  static constexpr std::size_t kAngleBins = 12;

  std::size_t faces = 0;
  std::size_t degenerate_faces = 0;  // without area: r/l and r are infinite

  double min_angle = 0, max_angle = 0;  // degrees
  // Facets by their smallest angle, in steps of 5 degrees: [0, 5), ... [55, 60].
  std::array<std::size_t, kAngleBins> angle_histogram{};

  double max_r_over_l = 0;
  // r/l at the quantiles kQuantiles: the smallest value not exceeded by that share of the facets.
  std::array<double, kQuantiles.size()> r_over_l_quantiles{};
  double max_r_over_l_above_r_min = 0;  // of facets with r > r_min
  std::size_t over_lambda = 0;          // r/l > lambda, at any size
  std::size_t over_lambda_above_r_min = 0;

  double max_radius = 0;
  double area = 0;
  double min_edge = 0, mean_edge = 0, max_edge = 0;  // each edge of linked facets once
};

// Returns the quality; all zeros for a mesh without facets. Lengths, r_min too, are in the unit of
// the points. pre: I1.
MeshQuality measure_quality(const TriMesh& mesh, double lambda, double r_min);

// Returns the volume that the facets enclose, positive if they are counter-clockwise seen from
// outside. Defined for closed meshes only. pre: linked.
double enclosed_volume(const TriMesh& mesh);

}  // namespace deliso
