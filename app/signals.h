// SPDX-License-Identifier: MIT
// What the system tells by a signal, as one line and the exit status for bad input instead.
#pragma once

#include <csignal>

namespace deliso {

// From now on a file that somebody shortens while it is mapped ends the program by one line that
// names it, and a file that grows beyond the system's limit (RLIMIT_FSIZE) makes write() fail.
void handle_signals();

// Keeps SIGINT, SIGTERM and SIGHUP waiting for as long as it lives, so that they do not leave a
// temporary file behind: writing takes a moment, and then the signal has its way.
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
