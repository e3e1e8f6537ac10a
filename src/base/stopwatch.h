// SPDX-License-Identifier: MIT
// Wall-clock seconds.
#pragma once

#include <chrono>

namespace deliso {

// The seconds since its construction.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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
