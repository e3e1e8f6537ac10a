// SPDX-License-Identifier: MIT
// The one division: a volume is cut into blocks, each is meshed by itself, and the meshes are
// welded. Only here do the stages meet threads. What is global happens before the blocks or after
// them: chosen components, desired counts, the report's sums.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block.h"

namespace deliso {

// True if the grid's planes follow from the samples (blocks/equal_shares.h). A part then reads all
// of the volume. So it is where no side is asked for, in volumes that one process meshes in
// seconds. Larger ones have many blocks anyway.
bool grid_follows_surface(const Volume& shape, const Options& options);

// Returns the grid of blocks of a run by these options that is not one block. Reads the source if
// the grid follows from it.
BlockGrid block_grid(const VolumeSource& source, double isovalue, const Options& options);
// Returns the grid of equal sides, which follows from the shape alone.
BlockGrid block_grid(const Volume& shape, const Options& options);

// Returns the mesh of {g = kappa} in a part of the volume's cells, as a welded block. It is refined
// at the seams within the part, and without caps. With a desired count it has more vertices or
// triangles than desired, and all reference samples. `kept`: per component of the whole contour,
// nonzero if it is kept; empty: options.components decides. pre: the source can be read where the
// part is; everywhere, if components are chosen. Throws InputError beyond --max-vertices.
Block mesh_in_blocks(const VolumeSource& source, double kappa, const Options& options,
                     const Parameters& parameters, std::vector<std::uint8_t> kept, PartChoice part,
                     Report& report);

// Returns the mesh of the whole from its parts, which are all there, in their order: welds them,
// and refines at the seams between them. It is the one that mesh_in_blocks() makes of the whole.
// Throws InputError if the parts do not fit together, or beyond --max-vertices.
Block join_parts(const VolumeSource& source, double kappa, const Options& options,
                 const Parameters& parameters, std::vector<Block> parts, Report& report);

}  // namespace deliso
