// SPDX-License-Identifier: MIT
// Turns signals about files into one line and the exit status for bad input.
#pragma once

#include <csignal>

namespace deliso {

// Handles signals about files. If a mapped file is shortened, the program ends with one line that
// names it. If a file grows beyond the system's limit (RLIMIT_FSIZE), write() fails.
void handle_signals();

// Blocks SIGINT, SIGTERM and SIGHUP during its lifetime, so that they leave no temporary file. They
// take effect after the write.
class DeferSignals {
 public:
  DeferSignals();
  ~DeferSignals();
  DeferSignals(const DeferSignals&) = delete;
  DeferSignals& operator=(const DeferSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace deliso
