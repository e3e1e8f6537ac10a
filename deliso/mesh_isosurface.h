// SPDX-License-Identifier: MIT
// The whole way from a volume to a mesh, as options ask for it: the exact program, block by block
// (blocks/mesh_in_blocks.h); then what only the whole mesh can have: a number of vertices
// (more/counts), caps (more/cap). The published program is paper/deliso.h.
#pragma once

#include <vector>

#include "blocks/block.h"
#include "mesh/tri_mesh.h"
#include "run/options.h"
#include "run/report.h"
#include "volume/volume.h"

namespace deliso {

// Returns the mesh of {g = kappa} in the scaled frame, with the frame of the volume. kappa is
// geometric_isovalue(). Facets are counter-clockwise seen from g < kappa. The mesh is empty if no
// voxel holds the isovalue. With options.cap the caps follow the surface, from
// report.cap.surface_triangles on; they may be a whole box. Throws InputError for a volume without
// a voxel, beyond the limits of run/options.h and beyond --max-vertices. pre: all samples are
// in range (value_range() was called).
TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options,
                        Report& report);

// The same without a report. Throws InputError for a sample out of range (value_range()), too.
TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options = {});

// A volume meshed in parts, by several processes that share nothing. The mesh of all parts is that
// of mesh_isosurface(), to the last bit.

// Returns the box of all samples that mesh_part() reads, unless components are chosen: the smallest
// that holds the part's blocks, and a margin; all of the volume if its samples decide the grid
// (blocks/mesh_in_blocks.h). Of a part without a block it is around some voxel.
SampleBox box_of_part(const Grid& shape, const Options& options, PartChoice part);

// Returns the mesh of one part, with what its seams to others still need, and its report. It is
// empty where there is no surface. Caps are left to mesh_of_parts(). pre: the source can be read in
// box_of_part(); everywhere if components are chosen. Throws InputError as mesh_isosurface() does,
// and for options that need all of the mesh at once (a desired count).
Block mesh_part(const VolumeSource& source, double isovalue, const Options& options,
                PartChoice part);

// Returns the mesh of all parts, in their order, which were made with the same source and options.
// Reads samples around the seams between parts; all of them with options.cap. Throws InputError if
// the parts do not fit together.
TriMesh mesh_of_parts(const VolumeSource& source, double isovalue, const Options& options,
                      std::vector<Block> parts, Report& report);

}  // namespace deliso
