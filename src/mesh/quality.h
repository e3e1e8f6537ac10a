// SPDX-License-Identifier: MIT
// The shapes of a mesh's triangles, in one summary. r is a triangle's circumradius, l its shortest
// edge (paper §3.1): r/l <= lambda bounds the smallest angle from below by asin(1 / (2 lambda)).
#pragma once

#include <array>
#include <cstddef>

#include "mesh/tri_mesh.h"

namespace deliso {

struct MeshQuality {
  static constexpr std::array kQuantiles{0.25, 0.5, 0.75, 0.9, 0.99, 1.0};
  static constexpr std::size_t kAngleBins = 12;

  std::size_t faces = 0;
  std::size_t degenerate_faces = 0;  // of no area: r/l and r are infinite

  // Degrees. The facets are the first that have the value; kNoId in an empty mesh.
  double min_angle = 0, max_angle = 0;
  FaceId min_angle_face = kNoId, max_angle_face = kNoId;
  // Facets by their smallest angle, in steps of 5 degrees: [0, 5), ... [55, 60].
  std::array<std::size_t, kAngleBins> angle_histogram{};

  double max_r_over_l = 0;
  FaceId max_r_over_l_face = kNoId;
  // r/l at the quantiles kQuantiles: the smallest value that so large a share does not exceed.
  std::array<double, kQuantiles.size()> r_over_l_quantiles{};
  double max_r_over_l_above_r_min = 0;  // of facets with r > r_min
  std::size_t over_lambda = 0;          // r/l > lambda, at any size
  std::size_t over_lambda_above_r_min = 0;

  double max_radius = 0;
  double min_area = 0, area = 0;
  double min_edge = 0, mean_edge = 0, max_edge = 0;  // each edge once, as far as facets are linked
};

// Lengths are in the unit of the points, and so is r_min. All zeros for a mesh without facets.
// pre: I1.
MeshQuality measure_quality(const TriMesh& mesh, double lambda, double r_min);

// The volume that the facets enclose, positive where they are counter-clockwise seen from outside.
// Means something for closed meshes only. pre: linked.
double enclosed_volume(const TriMesh& mesh);

}  // namespace deliso
