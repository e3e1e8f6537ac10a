// SPDX-License-Identifier: MIT
// Wall clock times of a run's steps, for its report.
#pragma once

#include "base/stopwatch.h"

namespace deliso {

// Adds the time from its construction to its destruction to `seconds`.
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

// Returns make(), and adds its time to `seconds`.
template <class Make>
auto timed(double& seconds, Make&& make) {
  const StepTimer timer(seconds);
  return make();
}

}  // namespace deliso
