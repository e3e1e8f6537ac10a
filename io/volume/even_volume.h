// SPDX-License-Identifier: MIT
// Slices of uneven distances, as of a scan that is coarser from some place on. Meshing needs a
// regular grid.
#pragma once

#include <vector>

#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {

// Returns `slices` in the even grid, interpolated linearly from slice to slice, and notes it.
// `places` are those of the slices along z, in samples of the grid. They increase, from its first
// slice to its last.
Volume resampled_evenly(const VolumeInput& input, SampleGrid grid,
                        const std::vector<double>& places, const Volume& slices);

}  // namespace deliso
