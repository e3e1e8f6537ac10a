// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"

namespace deliso {

class WorstFirst {
 public:
  explicit WorstFirst(const Box3& box, double voxel) : lo_(box.lo) {
    const char* e = getenv("WF_SIDE");
    const double side = (e ? atof(e) : 16) * voxel;
    if (const char* b = getenv("WF_BAND")) band_ = atoi(b);
    per_ = 1 / side;
    for (int a = 0; a < 3; ++a) n_[a] = std::max(1, std::min(64, static_cast<int>(box.size()[a] * per_) + 1));
    blocks_ = static_cast<std::size_t>(n_[0]) * n_[1] * n_[2];
  }
  // Replaces what is queued for f. violation > 1: queue it; else: take it out.
  void set(FaceId f, double violation, const Vec3& p) {
    if (f >= bucket_of_.size()) bucket_of_.resize(f + 1, kNone);
    size_ -= bucket_of_[f] != kNone;
    bucket_of_[f] = kNone;
    if (!(violation > 1)) return;
    ++size_;
    const double fourth = violation * violation * violation * violation;
    const int bucket = fourth < 0x1p63 ? std::ilogb(fourth) : kBuckets - 1;
    bucket_of_[f] = static_cast<std::uint8_t>(bucket);
    const int band = bucket / band_;
    std::size_t at[3];
    for (int a = 0; a < 3; ++a)
      at[a] = static_cast<std::size_t>(std::clamp(static_cast<int>((p[a] - lo_[a]) * per_), 0, n_[a] - 1));
    auto& b = bands_[static_cast<std::size_t>(band)];
    if (b.blocks.empty()) b.blocks.resize(blocks_);
    auto& q = b.blocks[at[0] + n_[0] * (at[1] + n_[1] * at[2])];
    q.push_back({static_cast<std::uint32_t>(bucket), f});
    std::push_heap(q.begin(), q.end());
    ++b.size;
    top_ = std::max(top_, band);
  }

  // The next facet, taken out; kNoId when none is left.
  FaceId pop() {
    for (; top_ >= 0; --top_) {
      auto& b = bands_[static_cast<std::size_t>(top_)];
      while (b.size > 0) {
        while (b.blocks[cursor_].empty()) cursor_ = (cursor_ + 1) % blocks_;
        auto& q = b.blocks[cursor_];
        std::pop_heap(q.begin(), q.end());
        const auto [bucket, f] = q.back();
        q.pop_back();
        --b.size;
        if (bucket_of_[f] != bucket) continue;  // replaced since
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
  struct Band {
    std::vector<std::vector<std::pair<std::uint32_t, FaceId>>> blocks;
    std::size_t size = 0;
  };
  Vec3 lo_;
  double per_;
  int n_[3];
  int band_ = 8;
  std::size_t blocks_;
  std::array<Band, kBuckets> bands_;
  std::vector<std::uint8_t> bucket_of_;
  int top_ = -1;
  std::size_t cursor_ = 0;
  std::size_t size_ = 0;
};

}  // namespace deliso
