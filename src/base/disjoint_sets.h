// SPDX-License-Identifier: MIT
// Disjoint sets of the numbers from 0 on (union-find); a set's representative is its smallest
// member.
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
  explicit DisjointSets(std::size_t n = 0) : parent_(n) { part(); }

  // Makes every member a set of its own.
  void part() { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  // Returns for every member the number of its set: sets are numbered by their smallest members,
  // in order. Takes the memory of the sets, which are gone.
  std::vector<std::uint32_t> take_numbers() {
    std::uint32_t count = 0;
    // Parents come before their children, so theirs is a number already.
    for (std::uint32_t n = 0; n < parent_.size(); ++n) {
      parent_[n] = parent_[n] == n ? count++ : parent_[parent_[n]];
    }
    return std::exchange(parent_, {});
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace deliso
