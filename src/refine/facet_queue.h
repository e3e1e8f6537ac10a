// SPDX-License-Identifier: MIT
// A queue of facets, the worst first; of equally bad ones the one with the largest id.
#pragma once

#include <queue>
#include <utility>
#include <vector>

#include "base/ids.h"

namespace deliso {

class FacetQueue {
 public:
  // Queues f with this violation, or removes it if the violation is at most 1.
  void set(FaceId f, double violation) {
    if (f >= violations_.size()) violations_.resize(f + 1, kNone);
    violations_[f] = violation > 1 ? violation : kNone;
    if (violation > 1) queue_.emplace(violation, f);
  }

  // Removes the first facet and returns it; kNoId if the queue is empty.
  FaceId pop() {
    while (!queue_.empty()) {
      const auto [violation, f] = queue_.top();
      queue_.pop();
      if (violations_[f] != violation) continue;  // replaced since
      violations_[f] = kNone;
      return f;
    }
    return kNoId;
  }

  // Returns the number of queued facets, or more: replaced entries count until they are popped.
  std::size_t size() const { return queue_.size(); }

 private:
  static constexpr double kNone = 0;

  std::priority_queue<std::pair<double, FaceId>> queue_;
  IdArray<FaceId, double> violations_;
};

}  // namespace deliso
