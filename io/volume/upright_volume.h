// SPDX-License-Identifier: MIT
// The slices of a CT with a tilted gantry stand upright, but each is shifted within its plane
// against the one before. Meshing needs a rectangular grid.
#pragma once

#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {

// Returns the grid whose third step is along the normal of the slices: `grid` itself if its slices
// are not shifted, or so much that a grid around all of them would be mostly empty.
SampleGrid upright_grid(const SampleGrid& grid);

// Returns `slices` in a grid around all of them, interpolated linearly within their planes, and
// notes it. Samples outside of a slice are the least of all. pre: `slices` are all those of `grid`,
// read by upright_grid(grid).
Volume resampled_upright(const VolumeInput& input, const SampleGrid& grid, const Volume& slices);

}  // namespace deliso
