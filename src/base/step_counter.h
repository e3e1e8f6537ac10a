// SPDX-License-Identifier: MIT
// What every observer of a run hears of its stages. Steps of a stage are counted: at every 1024th
// it reports, and polls for cancellation.
#pragma once

#include <cstddef>

#include "base/cancel.h"

namespace deliso {

class StageObserver {
 public:
  virtual ~StageObserver() = default;

  virtual void stage_begins(const char* /*stage*/) {}
  // The stage has done `done` steps, and `queued` more are known.
  virtual void steps_done(std::size_t /*done*/, std::size_t /*queued*/) {}
};

// The observer may be null, here and below.
inline void begin_stage(StageObserver* observer, const char* stage) {
  if (observer) observer->stage_begins(stage);
}

class Steps {
 public:
  explicit Steps(StageObserver* observer) : observer_(observer) {}

  void step(std::size_t queued) {
    constexpr std::size_t kStepsPerReport = 1024;
    if (++done_ % kStepsPerReport != 0) return;
    throw_if_canceled();
    if (observer_) observer_->steps_done(done_, queued);
  }

 private:
  StageObserver* observer_;
  std::size_t done_ = 0;
};

}  // namespace deliso
