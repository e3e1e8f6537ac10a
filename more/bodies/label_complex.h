// SPDX-License-Identifier: MIT
// T_L: the complex that divides space among the bodies of the samples. It has the right topology,
// and does not cross itself, wherever its points lie within their simplices.
//
// Each voxel is cut into Freudenthal's six tetrahedra: the paths of three steps along the axes from
// its first corner to its last. In a tetrahedron a point belongs to the body with the largest sum
// of barycentric coordinates. So a body's region is a regular neighborhood of the subcomplex that
// its samples span, and its boundary is a manifold (docs/proof.md). The border has
//   - a point on each edge between two bodies, where their fields are equal;
//   - a point in each triangle of three bodies, joined to those on its edges: a curve passes there;
//   - in a tetrahedron of two bodies the triangle or the quadrilateral of those on its edges;
//   - in one of three or four bodies a point, and the cone from it over the segments in its faces;
//   - in triangles on the box the regions themselves, which border on the bodies beyond.
#pragma once

#include <cstdint>
#include <vector>

#include "more/bodies/partition.h"
#include "more/bodies/sheets.h"

namespace deliso {

// T_L in a box of samples.
struct LabelComplex {
  Sheets sheets;
  // Of each point, the simplex that holds it: its least sample's number, times kSimplices, plus the
  // number of the simplex among those of which it is the least. Ascending.
  std::vector<std::uint64_t> simplex;
  static constexpr std::uint64_t kSimplices = 32;
};

LabelComplex label_complex(const Partition& partition, const SampleBox& box);

}  // namespace deliso
