// SPDX-License-Identifier: MIT
// How long the steps of a run take, for its report.
#pragma once

#include <chrono>

namespace deliso {

// Adds the seconds of its own life to a step's.
class StepTimer {
 public:
  explicit StepTimer(double& seconds) : seconds_(seconds) {}
  StepTimer(const StepTimer&) = delete;
  StepTimer& operator=(const StepTimer&) = delete;
  ~StepTimer() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What make() returns, with its time added.
template <class Make>
auto timed(double& seconds, Make&& make) {
  const StepTimer timer(seconds);
  return make();
}

}  // namespace deliso
