// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace deliso {

// Returns the most memory that the process has held in RAM since it began to run its program. In a
// host of the library that is the host's.
std::uint64_t peak_memory_bytes();

}  // namespace deliso
