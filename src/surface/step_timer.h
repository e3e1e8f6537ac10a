// SPDX-License-Identifier: MIT
// How long the steps of a run take, for its report.
#pragma once

#include "base/stopwatch.h"

namespace deliso {

// Adds the seconds of its own life to a step's.
class StepTimer {
 public:
  explicit StepTimer(double& seconds) : seconds_(seconds) {}
  StepTimer(const StepTimer&) = delete;
  StepTimer& operator=(const StepTimer&) = delete;
  ~StepTimer() { seconds_ += watch_.seconds(); }

 private:
  double& seconds_;
  Stopwatch watch_;
};

// What make() returns, with its time added.
template <class Make>
auto timed(double& seconds, Make&& make) {
  const StepTimer timer(seconds);
  return make();
}

}  // namespace deliso
