// SPDX-License-Identifier: MIT
// Compares the components of a mesh with those of the exact contour: which corresponds to which,
// and whether both are the same surface.
#pragma once

#include <cstdint>
#include <vector>

#include "check/faults.h"
#include "check/validity.h"
#include "check/voxel_components.h"
#include "contour/contour.h"
#include "isosurface/isosurface.h"

namespace deliso {

// What a mesh is held against.
struct ExactSurface {
  // `tolerance`: of vertices on Sigma.
  ExactSurface(const Isosurface& of, double tolerance)
      : surface(of),
        contour(build_contour(of.volume(), of.kappa())),
        voxels(contour, of.volume(), tolerance) {}

  const Isosurface& surface;
  ContourMesh contour;     // T
  VoxelComponents voxels;  // of T
};

struct ComparedComponents {
  std::vector<std::uint32_t> match;  // of T, per component of the mesh; kNoId if it is extra
  std::vector<std::uint8_t> kept;    // per component of T: chosen, or in the mesh though not chosen
  std::uint64_t equal = 0;           // pairs with equal Euler number and boundary loops
};

// Matches the components of the mesh with those of T, and reports missing, extra, different and
// reversed ones into `faults`.
//
// Up to 64 vertices of a component of the mesh, evenly spread, vote. A vertex lies on Sigma, so it
// is on the component of T in its voxel if the voxel holds one. These vertices decide. If there are
// none, the component in these voxels that most vertices are nearest to decides, first by those
// whose nearest triangle has Sigma's orientation. A vertex off Sigma asks the voxels around if its
// own holds none. If most find none there, the component is extra. If several match the same one,
// that with most triangles counts and the others are extra.
//
// Components that are not chosen may be missing. A component is reversed by its boundary
// (check/boundary_orientation.h). If that does not tell, by the sign of the volume that it bounds
// (check/bounded_volume.h). `tolerance`: of vertices on Sigma.
ComparedComponents compare_components(const CleanMesh& mesh, const ExactSurface& exact,
                                      double tolerance, const ComponentChoice& choice, int threads,
                                      Faults& faults);

}  // namespace deliso
