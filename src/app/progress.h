// SPDX-License-Identifier: MIT
// A progress bar on standard error: only where that is a terminal, and gone again when done.
#pragma once

#include <chrono>

namespace deliso {

class Progress {
 public:
  // Shows nothing when `wanted` is false, or standard error is no terminal that can redraw a line.
  explicit Progress(bool wanted);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `share` of the stage is done, in [0, 1]. Cheap to call often: draws ten times a second.
  void show(const char* stage, double share);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool coloured_;
  bool drawn_ = false;
  Clock::time_point last_;
};

}  // namespace deliso
