// SPDX-License-Identifier: MIT
// A volume meshed in parts, by several processes that share nothing (blocks/mesh_in_blocks.h). The
// mesh of all parts is that of mesh_isosurface(), to the last bit.
#pragma once

#include <vector>

#include "blocks/block.h"
#include "deliso/options.h"
#include "mesh/tri_mesh.h"
#include "surface/report.h"

namespace deliso {

// Returns the box of all samples that mesh_part() reads, unless components are chosen: the smallest
// that holds the part's blocks, and a margin; all of the volume if its samples decide the grid
// (blocks/mesh_in_blocks.h). Of a part without a block it is around some voxel.
SampleBox box_of_part(const Volume& shape, const Options& options, PartChoice part);

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
