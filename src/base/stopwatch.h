// SPDX-License-Identifier: MIT
// Wall-clock seconds.
#pragma once

#include <chrono>
#include <utility>

namespace deliso {

// The seconds since its construction, or since it was restarted.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  // Returns the seconds, and begins anew.
  double restart() {
    const Clock::time_point end = Clock::now();
    return std::chrono::duration<double>(end - std::exchange(start_, end)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
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
