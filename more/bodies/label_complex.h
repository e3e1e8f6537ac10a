// SPDX-License-Identifier: MIT
// T_L: the complex that divides space among the bodies of the samples. It has the right topology,
// and does not cross itself, wherever its points lie within their edges, faces and voxels.
//
// What it must be: each voxel is cut into 24 tetrahedra, from its middle over the middles of its
// faces to the ends of its edges. The middle of a face, and that of a voxel, belongs to the body of
// one of its corners: the one with the largest mean of the fields there, but thin layers stay
// closed. Of a face it is the body that has both ends of a diagonal, where the other diagonal's
// differ; of a voxel one that keeps others apart on its surface. In a tetrahedron a point
// belongs to the body with the largest sum of barycentric coordinates. So a body's region is a
// regular neighborhood of the subcomplex that its points span, its boundary is a manifold, and no
// direction is preferred: a mirrored volume has the mirrored topology (docs/proof-more.md).
//
// How it is made, with fewer points:
//   - an axis edge between two bodies has a point, where their fields are equal;
//   - a face is divided by arcs between these points: straight, or from one or two points in the
//     face where three bodies meet. Face middles decide which (face_regions.h);
//   - a voxel whose bodies have one piece each on its surface, each a disk, has the cone over the
//     arcs, or a triangle or two;
//   - another one belongs to the body of its middle, but for layers at its faces: a sheet over each
//     piece of another body, and a wall over each arc between two such bodies. Each sheet is a
//     graph over the faces, seen from the middle;
//   - faces on the box have the regions themselves, which border on the bodies beyond.
#pragma once

#include <cstdint>
#include <vector>

#include "more/bodies/partition.h"
#include "more/bodies/sheets.h"

namespace deliso {

// T_L in a box of samples.
struct LabelComplex {
  Sheets sheets;
  // Of each point, its place in the whole: a sample's number, times kPlaces, plus the number of the
  // edge, face or place in the voxel of which the sample is the least corner.
  std::vector<std::uint64_t> place;
  static constexpr std::uint64_t kPlaces = 64;
};

LabelComplex label_complex(const Partition& partition, const SampleBox& box);

}  // namespace deliso
