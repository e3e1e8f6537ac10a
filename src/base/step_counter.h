// SPDX-License-Identifier: MIT
// Counts the steps of a stage. At every 1024th it reports, and polls for cancellation.
#pragma once

#include <cstddef>

#include "base/cancel.h"

namespace deliso {

// Observer: has steps_done(done, queued).
template <class Observer>
class StepCounter {
 public:
  // `observer` may be null.
  explicit StepCounter(Observer* observer) : observer_(observer) {}

  void step(std::size_t queued) {
    constexpr std::size_t kStepsPerReport = 1024;
    if (++done_ % kStepsPerReport != 0) return;
    throw_if_canceled();
    if (observer_) observer_->steps_done(done_, queued);
  }

 private:
  Observer* observer_;
  std::size_t done_ = 0;
};

}  // namespace deliso
