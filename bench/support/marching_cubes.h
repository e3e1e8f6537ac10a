// SPDX-License-Identifier: MIT
// Marching Cubes (Lorensen and Cline 1987), the baseline of the paper's Figures 1 and 2. A table of
// 256 cases has the triangles of a voxel for the signs of its corners. Their corners are on grid
// edges, by linear interpolation.
//
// The original table leaves holes, because the two voxels at a face can join its four crossings in
// different ways. Here all cases follow one rule: inside corners that are diagonal in a face are
// never joined across it. The face's signs alone decide, so neighbors agree. The topology may
// differ from that of Sigma.
//
//   M1  The loops of a case are those of trace_loops(mask, 0) (contour/voxel_topology.h).
//   M2  Diagonals cut a loop into triangles. They lie inside the voxel, never in a face, where the
//       neighbor could have the same one. So the mesh is a manifold, open only at the box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

// Returns the triangles of a case, as crossed edges in the numbering of contour/voxel_topology.h.
// They are counter-clockwise seen from values below the isovalue. Bit m of `mask` is set if corner
// m is inside.
using VoxelTriangle = std::array<std::uint8_t, 3>;
std::vector<VoxelTriangle> marching_cubes_case(int mask);

// Returns the mesh of {g = kappa} in the volume's frame. A corner with a value of at least kappa is
// inside. Throws InputError at 2^32 - 1 vertices or more.
TriMesh marching_cubes(const Volume& volume, double kappa);

}  // namespace deliso
