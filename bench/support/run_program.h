// SPDX-License-Identifier: MIT
// Runs another program and reads its CPU time. POSIX.
#pragma once

#include <string>
#include <vector>

namespace deliso {

struct Ended {
  int status = 0;          // as the program returned it, or 128 + the signal that ended it
  double cpu_seconds = 0;  // of all its threads, the system's for it included
};

// Runs words[0] with the other words as its arguments and waits for its end. It is ended after
// `limit` seconds of CPU time. Its standard output is dropped. Throws InputError where it cannot
// be run. pre: `words` not empty.
Ended run_program(const std::vector<std::string>& words, unsigned limit);

}  // namespace deliso
