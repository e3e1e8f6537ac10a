// SPDX-License-Identifier: MIT
// Getting results out: standard output with its errors seen, files whole or not at all.
#pragma once

#include <csignal>
#include <string>
#include <string_view>

namespace deliso {

// Writes to standard output and flushes. Throws InputError when it cannot all be written.
void print(std::string_view text);

// Writes a file, whole or not at all; `-` is standard output. Throws InputError.
void write_text(const std::string& path, std::string_view text);

// Throws InputError where a file at `path` could not be written for a reason that can be told now
// rather than after the work: its folder is missing or may not be written to, or it is a folder.
void require_writable(const std::string& path);

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
