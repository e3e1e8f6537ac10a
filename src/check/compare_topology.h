// SPDX-License-Identifier: MIT
// Compares the components of a mesh with those of the exact contour: which corresponds to which,
// and whether both are the same surface.
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

// Matches the components of the mesh with those of T, and reports missing, extra, different and
// reversed ones into `faults`.
//
// Up to 64 vertices of a component of the mesh, evenly spread, vote for the nearest component of T.
// Vertices at vertices of T, or in voxels that hold one component, decide if there are any. Most of
// them must be within a voxel's diagonal of T. If several components match the same one, that with
// most triangles counts and the others are extra.
//
// Components that are not chosen may be missing. A component is reversed by its boundary
// (check/boundary_orientation.h). If that does not tell, by the sign of the volume that it bounds
// (contour/bounded_volume.h). `tolerance`: of vertices on the box.
ComparedComponents compare_components(const CleanMesh& mesh, const ContourMesh& contour,
                                      const Volume& volume, const ComponentChoice& choice,
                                      double tolerance, int threads, Faults& faults);

}  // namespace deliso
