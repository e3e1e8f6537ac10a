// SPDX-License-Identifier: MIT
// Adds the seconds of its own life to a step of the report.
#pragma once

#include <chrono>

namespace deliso {

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

}  // namespace deliso
