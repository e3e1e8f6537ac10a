// SPDX-License-Identifier: MIT
// Marching Cubes (Lorensen and Cline 1987), the baseline of the paper's Figures 1 and 2: for each
// voxel the triangles that a table of 256 cases holds for the signs of its corners, with corners on
// grid edges by linear interpolation.
//
// The original table leaves holes, because the two voxels at a face can take its four crossings
// apart in different ways. Here all cases follow one rule instead of being typed in: inside corners
// that are diagonal in a face are never joined across it. The face's signs alone decide, so
// neighbors agree. It is no more than that: the topology need not be that of Sigma.
//
//   M1  the loops of a case are those of trace_loops(mask, 0) (contour/voxel_topology.h);
//   M2  a loop is cut into triangles by diagonals that lie inside the voxel, never in a face, where
//       the neighbor could have the same one; so the mesh is a manifold, open at the box only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/command_line.h"
#include "deliso/deliso.h"
#include "mesh/tri_mesh.h"
#include "surface/report.h"
#include "volume/volume.h"

namespace deliso {

// The triangles of a case, as crossed edges in the numbering of contour/voxel_topology.h;
// counter-clockwise seen from where the value is below the isovalue. Bit m of `mask` is set where
// corner m is inside.
using VoxelTriangle = std::array<std::uint8_t, 3>;
std::vector<VoxelTriangle> marching_cubes_case(int mask);

// The mesh of {g = kappa}, in the scaled frame; a corner with a value of at least kappa is inside.
// Throws InputError when there are 2^32 - 1 vertices or more.
TriMesh marching_cubes(const Volume& volume, double kappa);

// The same, as mesh_isosurface() gives its mesh: in the volume's frame, closed on the box where
// options.cap asks for it, and with the report filled in. Of the other options only threads, the
// observer and the solver matter. Throws InputError as mesh_isosurface() does.
TriMesh mesh_by_cubes(const Volume& volume, double isovalue, const Options& options,
                      Report& report);

// Returns the function that makes a mesh this way.
inline decltype(mesh_isosurface)& mesher_of(Method method) {
  return method == Method::marching_cubes ? mesh_by_cubes : mesh_isosurface;
}

}  // namespace deliso
