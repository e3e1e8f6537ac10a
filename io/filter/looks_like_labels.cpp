// SPDX-License-Identifier: MIT
#include "io/filter/looks_like_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <type_traits>

#include "io/filter/segmentation.h"

namespace deliso {
namespace {

constexpr std::size_t kMostValues = 4096, kFewValues = 16;  // L1, L3
constexpr double kMostSteps = 0.75, kLeastJumps = 0.05;     // L3
constexpr std::size_t kSamplesSeen = std::size_t{1} << 22;

// The neighbors of one value's samples.
struct Neighbors {
  std::uint64_t all = 0, equal = 0;
};

class Tally {
 public:
  // Adds a row of samples. False if the samples are no labels, whatever follows.
  template <class T>
  bool add_row(const Volume& volume, const T* samples, int j, int k) {
    const Index3 dims = volume.dims();
    Neighbors* of_value = nullptr;
    for (int i = 0; i < dims.i; ++i) {
      const std::size_t at = volume.index(i, j, k);
      const T value = samples[at];
      if (!is_label(value)) return false;
      if (i == 0 || value != samples[at - 1]) {
        of_value = &values_[static_cast<std::int64_t>(value)];
        if (values_.size() > kMostValues) return false;
      }
      const Index3 here{i, j, k};
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          Index3 next = here;
          next[axis] += side;
          if (next[axis] < 0 || next[axis] >= dims[axis]) continue;
          const T other = samples[volume.index(next.i, next.j, next.k)];
          ++of_value->all;
          of_value->equal += other == value;
          if (other == value) continue;
          const double difference =
              std::abs(static_cast<double>(other) - static_cast<double>(value));
          ++differing_;
          ++by_[static_cast<std::size_t>(std::min(difference, double{kMostValues}))];
        }
      }
    }
    return true;
  }

  bool looks_like_labels() const {
    if (values_.size() < 2) return false;
    const auto is_flat = [](const Neighbors& of) { return 2 * of.equal >= of.all; };
    std::size_t flat = 0;
    Neighbors sum;
    for (const auto& [value, of] : values_) {
      flat += is_flat(of);
      sum = {sum.all + of.all, sum.equal + of.equal};
    }
    if (values_.size() <= kFewValues) return 2 * flat >= values_.size() || is_flat(sum);
    if (2 * flat < values_.size()) return false;
    const auto differing = static_cast<double>(differing_);
    const auto far = by_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 4 + 1);
    const auto jumps = std::accumulate(far, by_.end(), std::uint64_t{0});
    return static_cast<double>(by_[1]) <= kMostSteps * differing ||
           static_cast<double>(jumps) >= kLeastJumps * differing;
  }

 private:
  std::map<std::int64_t, Neighbors> values_;
  // Neighbors that differ; and by how much, the last for all larger differences.
  std::uint64_t differing_ = 0;
  std::array<std::uint64_t, kMostValues + 1> by_{};
};

}  // namespace

bool looks_like_labels(const Volume& volume) {
  const Index3 dims = volume.dims();
  const std::size_t rows = static_cast<std::size_t>(dims.j) * static_cast<std::size_t>(dims.k);
  const std::size_t step = 1 + volume.sample_count() / kSamplesSeen;
  return volume.visit([&](const auto* samples) {
    Tally tally;
    for (std::size_t row = 0; row < rows; row += step) {
      const int j = static_cast<int>(row % static_cast<std::size_t>(dims.j));
      const int k = static_cast<int>(row / static_cast<std::size_t>(dims.j));
      if (!tally.add_row(volume, samples, j, k)) return false;
    }
    return tally.looks_like_labels();
  });
}

}  // namespace deliso
