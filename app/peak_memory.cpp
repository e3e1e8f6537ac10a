// SPDX-License-Identifier: MIT
#include "app/peak_memory.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace deliso {

// Linux passes ru_maxrss on to the next program of a process (exec), and a process begins as a copy
// of its parent: a run started by a large program would have that program's peak. The high water
// mark in /proc begins anew with each program.
std::uint64_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace deliso
