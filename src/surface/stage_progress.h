// SPDX-License-Identifier: MIT
// Tells a caller how far a stage is: in parts one after another, each by what is done of that and
// what is queued. A queue grows while it is worked on, so that is a guess, but what is told never
// falls, and no part tells more than its own width.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace deliso {

class StageProgress {
 public:
  using Callback = std::function<void(const char* stage, double share)>;

  // `callback` must outlive this; it may be empty. Tells that the stage begins.
  StageProgress(const Callback& callback, const char* stage) : callback_(callback), stage_(stage) {
    if (callback_) callback_(stage_, 0);
  }

  // The part before is done. `width`: of the stage, or of what is left of it.
  void begin_part(double width) {
    begin_ = end_;
    end_ = std::min(1.0, end_ + std::max(0.0, width));
    done_ = 0;
    tell(begin_);
  }
  void begin_part_of_rest(double width) { begin_part(width * (1 - end_)); }

  // One more step of the part is done, with so many in its queue.
  void step(std::size_t queued) {
    constexpr std::size_t kEvery = 1024;
    if (++done_ % kEvery != 0) return;
    const auto done = static_cast<double>(done_);
    reach(done / (done + static_cast<double>(queued)));
  }
  // So much of the part is done, in [0, 1].
  void reach(double share) { tell(begin_ + (end_ - begin_) * std::clamp(share, 0.0, 1.0)); }

 private:
  void tell(double share) {
    share_ = std::max(share_, share);
    if (callback_) callback_(stage_, share_);
  }

  const Callback& callback_;
  const char* stage_;
  double begin_ = 0, end_ = 0, share_ = 0;
  std::size_t done_ = 0;
};

// Tells of a stage that says nothing more.
inline void begin_stage(const StageProgress::Callback& callback, const char* stage) {
  StageProgress(callback, stage);
}

}  // namespace deliso
