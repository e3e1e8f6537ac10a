// SPDX-License-Identifier: MIT
// Files that gzip may have compressed as a whole, header and samples: scan.nii.gz, emd_3001.map.gz,
// liver.inr.gz.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/files/input_file.h"
#include "io/volume/sample_grid.h"
#include "volume/volume.h"

namespace deliso {

bool is_gzip(const Bytes& bytes);

// Returns the first bytes of the file, or of what it decompresses to: `count`, or all if there are
// fewer. Throws InputError if they are damaged.
Bytes start_of(const Bytes& bytes, std::size_t count);

// Returns the volume whose samples follow the first `skip` bytes, to the end. Throws InputError.
Volume volume_behind(const SampleGrid& grid, const Bytes& bytes, std::uint64_t skip);

}  // namespace deliso
