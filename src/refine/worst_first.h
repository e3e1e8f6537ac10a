// SPDX-License-Identifier: MIT
// A queue that gives out the worst facets first, by fourths of an octave of how badly they violate
// a criterion: of those in one fourth the one added last comes first, which keeps the work in one
// place of the mesh and of memory. Exact order would cost a heap operation per facet and buys no
// smaller meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"

namespace deliso {

class WorstFirst {
 public:
  // Replaces what is queued for f. violation > 1: queue it; else: take it out.
  void set(FaceId f, double violation) {
    if (f >= bucket_of_.size()) bucket_of_.resize(f + 1, kNone);
    size_ -= bucket_of_[f] != kNone;
    bucket_of_[f] = kNone;
    if (!(violation > 1)) return;
    ++size_;
    const double fourth = violation * violation * violation * violation;
    const int bucket = fourth < 0x1p63 ? std::ilogb(fourth) : kBuckets - 1;
    bucket_of_[f] = static_cast<std::uint8_t>(bucket);
    buckets_[static_cast<std::size_t>(bucket)].push_back(f);
    top_ = std::max(top_, bucket);
  }

  // The next facet, taken out; kNoId when none is left.
  FaceId pop() {
    for (; top_ >= 0; --top_) {
      std::vector<FaceId>& bucket = buckets_[static_cast<std::size_t>(top_)];
      while (!bucket.empty()) {
        const FaceId f = bucket.back();
        bucket.pop_back();
        if (bucket_of_[f] != top_) continue;  // replaced since
        bucket_of_[f] = kNone;
        --size_;
        return f;
      }
    }
    return kNoId;
  }

  std::size_t size() const { return size_; }

 private:
  static constexpr int kBuckets = 64;
  static constexpr std::uint8_t kNone = 255;
  std::array<std::vector<FaceId>, kBuckets> buckets_;
  std::vector<std::uint8_t> bucket_of_;
  int top_ = -1;
  std::size_t size_ = 0;
};

}  // namespace deliso
