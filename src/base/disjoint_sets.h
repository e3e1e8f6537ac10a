// SPDX-License-Identifier: MIT
// Disjoint sets of the numbers 0 to n - 1 (union-find). The smallest member represents its set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace deliso {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n = 0) : parent_(n) { reset(); }

  // Makes every member a set of its own.
  void reset() { std::iota(parent_.begin(), parent_.end(), 0u); }
  // Adds one more member, a set of its own, and returns it.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  // Returns the number of every member's set. Sets are numbered in the order of their smallest
  // members. Leaves no sets: their memory is reused for the result.
  std::vector<std::uint32_t> take_numbers() {
    std::uint32_t count = 0;
    // A parent has a smaller number than its children, so it was replaced before them.
    for (std::uint32_t n = 0; n < parent_.size(); ++n) {
      parent_[n] = parent_[n] == n ? count++ : parent_[parent_[n]];
    }
    return std::exchange(parent_, {});
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace deliso
