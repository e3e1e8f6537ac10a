// SPDX-License-Identifier: MIT
// The default number of threads, for headers that start none.
#pragma once

#include <algorithm>
#include <thread>

namespace deliso {

// Returns how many threads this machine runs at once.
inline int hardware_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace deliso
