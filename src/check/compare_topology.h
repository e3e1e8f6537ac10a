// SPDX-License-Identifier: MIT
// A mesh's components beside those of the exact contour: which is which, and whether they are the
// same surface.
#pragma once

#include <cstdint>
#include <vector>

#include "check/faults.h"
#include "check/validity.h"
#include "contour/contour.h"
#include "volume/volume.h"

namespace deliso {

struct ComparedComponents {
  std::vector<std::uint8_t> extra;  // per component of the mesh
  std::uint64_t equal = 0;          // pairs with equal Euler number and boundary loops
  std::uint64_t left_out = 0;       // missing, and not chosen
};

// A component of the mesh stands for that of T which most of its vertices are nearest to (64 of
// them are asked, evenly spread; those at vertices of T or in voxels that hold one component
// decide, where there are any), provided that is no further than a voxel's diagonal from most of
// them. Where several stand for the same, the one with most triangles counts and the others are
// extra. Components that are not chosen may be
// missing. Reports missing, extra, different and turned components into `faults`: turned by the
// sign of what it bounds (contour/bounded_volume.h), or of those that meet opposite faces of the
// box by most of its area.
ComparedComponents compare_components(const CleanMesh& mesh, const ContourMesh& contour,
                                      const Volume& volume, const ComponentChoice& choice,
                                      int threads, Faults& faults);

}  // namespace deliso
