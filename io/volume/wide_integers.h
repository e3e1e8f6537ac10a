// SPDX-License-Identifier: MIT
// Integers of 64 bits, which no volume has. If float64 holds all of the samples exactly, they
// become float64. Else they may be the ids of a segmentation: then they are numbered. The samples
// become uint32, and sample n stands for ids[n], the ids in ascending order (ReadLog::ids).
#pragma once

#include <cstddef>
#include <span>

#include "io/volume/sample_grid.h"
#include "volume/volume.h"

namespace deliso {

// Converts the words, in native order, in their place; of uint32 the first half has the samples.
// Returns the type that they have then. Throws InputError with the range of the words if float64
// does not hold them and they cannot be numbered: they are not read as labels, are over 2^63 - 1,
// or have over 2^20 different values.
SampleType convert_wide(const SampleGrid& grid, std::span<std::byte> words);

}  // namespace deliso
