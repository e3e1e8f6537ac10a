// SPDX-License-Identifier: MIT
// Samples without a value: statistical maps and masked images have NaN outside of their mask.
#pragma once

#include <cstdint>

#include "volume/volume.h"

namespace deliso {

// Returns the volume with `value` in place of NaN, and adds the number of such samples to `count`.
// Without any the samples are shared.
Volume without_nan(const Volume& volume, double value, std::uint64_t& count);

}  // namespace deliso
