// SPDX-License-Identifier: MIT
#include "io/filter/median.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "io/files/input_file.h"
#include "io/filter/reflect.h"

namespace deliso {
namespace {

// Samples of the result that are computed together. With the margin of the largest radius they have
// fewer than 2^16 ranks; margins of longer tiles would be a smaller share, but leave the cache.
constexpr Index3 kTile{32, 12, 12};
constexpr std::size_t kBinsOfBlock = 256;

// A multiset of bins that keeps a place, so that the next median is found from the last one.
class Window {
 public:
  explicit Window(std::size_t bins)
      : blocks_((bins + kBinsOfBlock - 1) / kBinsOfBlock), counts_(blocks_.size() * kBinsOfBlock) {}

  void add(std::uint16_t bin) {
    ++counts_[bin];
    ++blocks_[bin / kBinsOfBlock];
    below_ += bin < at_;
  }
  void remove(std::uint16_t bin) {
    --counts_[bin];
    --blocks_[bin / kBinsOfBlock];
    below_ -= bin < at_;
  }
  // Returns the bin of the element with `rank` others before it in order. pre: there are more.
  std::size_t bin_of_rank(int rank) {
    while (below_ > rank) {
      const int block = at_ % kBinsOfBlock == 0 ? blocks_[at_ / kBinsOfBlock - 1] : 0;
      const bool skips = at_ % kBinsOfBlock == 0 && below_ - block > rank;
      at_ -= skips ? kBinsOfBlock : 1;
      below_ -= skips ? block : counts_[at_];
    }
    while (below_ + counts_[at_] <= rank) {
      const bool skips = at_ % kBinsOfBlock == 0 && below_ + blocks_[at_ / kBinsOfBlock] <= rank;
      below_ += skips ? blocks_[at_ / kBinsOfBlock] : counts_[at_];
      at_ += skips ? kBinsOfBlock : 1;
    }
    return at_;
  }

 private:
  std::vector<std::uint16_t> blocks_, counts_;
  std::size_t at_ = 0;
  int below_ = 0;  // elements in bins below at_
};

// The bins of a tile's samples, with a margin of the radius on all sides.
template <class T>
class Tile {
  static constexpr bool kBinsAreValues = std::is_integral_v<T> && sizeof(T) <= 2;

 public:
  Tile(const T* samples, Index3 dims, int radius)
      : samples_(samples), dims_(dims), radius_(radius) {
    for (int axis = 0; axis < 3; ++axis) size_[axis] = kTile[axis] + 2 * radius;
    bins_.resize(static_cast<std::size_t>(size_.i) * static_cast<std::size_t>(size_.j) *
                 static_cast<std::size_t>(size_.k));
  }
  std::size_t bin_count() const {
    return kBinsAreValues ? std::size_t{1} << (8 * sizeof(T)) : bins_.size();
  }

  // Reads the tile whose first sample is `first`.
  void read(Index3 first) {
    if constexpr (!kBinsAreValues) order_.clear();
    std::size_t n = 0;
    for (int k = 0; k < size_.k; ++k) {
      for (int j = 0; j < size_.j; ++j) {
        const T* const row = row_at(reflected(first.j + j - radius_, dims_.j),
                                    reflected(first.k + k - radius_, dims_.k));
        for (int i = 0; i < size_.i; ++i, ++n) {
          const T value = row[reflected(first.i + i - radius_, dims_.i)];
          if constexpr (kBinsAreValues) {
            bins_[n] = static_cast<std::uint16_t>(value - std::numeric_limits<T>::lowest());
          } else {
            order_.emplace_back(value, static_cast<std::uint16_t>(n));
          }
        }
      }
    }
    if constexpr (!kBinsAreValues) {
      std::sort(order_.begin(), order_.end());
      for (std::size_t rank = 0; rank < order_.size(); ++rank) {
        bins_[order_[rank].second] = static_cast<std::uint16_t>(rank);
      }
    }
  }
  T value_of(std::size_t bin) const {
    if constexpr (kBinsAreValues) {
      return static_cast<T>(static_cast<int>(bin) + std::numeric_limits<T>::lowest());
    } else {
      return order_[bin].first;
    }
  }

  // Calls f with the bins of a column: all that a window along row (j, k) of the tile has at i.
  template <class F>
  void for_column(int i, int j, int k, F&& f) const {
    for (int dk = 0; dk <= 2 * radius_; ++dk) {
      for (int dj = 0; dj <= 2 * radius_; ++dj) {
        f(bins_[static_cast<std::size_t>(((k + dk) * size_.j + j + dj) * size_.i + i)]);
      }
    }
  }

 private:
  const T* row_at(int j, int k) const {
    return samples_ + static_cast<std::size_t>(dims_.i) *
                          (static_cast<std::size_t>(j) +
                           static_cast<std::size_t>(dims_.j) * static_cast<std::size_t>(k));
  }

  const T* samples_;
  Index3 dims_;
  int radius_;
  Index3 size_;
  std::vector<std::uint16_t> bins_;
  std::vector<std::pair<T, std::uint16_t>> order_;  // by value, then by place
};

// Writes the medians of row (j, k) of the tile, `length` of them. The window is empty before and
// after.
template <class T>
void filter_row(const Tile<T>& tile, Window& window, int radius, int j, int k, int length, T* to) {
  const int side = 2 * radius + 1, rank = side * side * side / 2;
  const auto add = [&](std::uint16_t bin) { window.add(bin); };
  const auto remove = [&](std::uint16_t bin) { window.remove(bin); };
  for (int i = 0; i < 2 * radius; ++i) tile.for_column(i, j, k, add);
  for (int i = 0; i < length; ++i) {
    tile.for_column(i + 2 * radius, j, k, add);
    to[i] = tile.value_of(window.bin_of_rank(rank));
    tile.for_column(i, j, k, remove);
  }
  for (int i = length; i < length + 2 * radius; ++i) tile.for_column(i, j, k, remove);
}

template <class T>
Volume filtered(const Volume& volume, const T* samples, int radius, int threads) {
  const Index3 dims = volume.dims();
  Buffer buffer(sizeof(T) * volume.sample_count());
  T* const out = reinterpret_cast<T*>(buffer.data.get());
  const auto tiles_along = [&](int axis) {
    return runs_of(static_cast<std::size_t>(dims[axis]), static_cast<std::size_t>(kTile[axis]));
  };
  // A task is all tiles along x.
  for_each_task(threads, tiles_along(1) * tiles_along(2), [&](std::size_t task) {
    Tile<T> tile(samples, dims, radius);
    Window window(tile.bin_count());
    Index3 first;
    first.j = static_cast<int>(task % tiles_along(1)) * kTile.j;
    first.k = static_cast<int>(task / tiles_along(1)) * kTile.k;
    for (; first.i < dims.i; first.i += kTile.i) {
      tile.read(first);
      const int length = std::min(kTile.i, dims.i - first.i);
      for (int k = 0; k < std::min(kTile.k, dims.k - first.k); ++k) {
        for (int j = 0; j < std::min(kTile.j, dims.j - first.j); ++j) {
          filter_row(tile, window, radius, j, k, length,
                     out + volume.index(first.i, first.j + j, first.k + k));
        }
      }
    }
  });
  const Bytes bytes = bytes_of(std::move(buffer), {});
  return volume.with_samples(volume.type(), bytes.data.data(), bytes.owner);
}

}  // namespace

Volume median(const Volume& volume, int radius, int threads) {
  DELISO_CHECK(radius >= 1 && radius <= kLargestMedianRadius);
  return volume.visit(
      [&](const auto* samples) { return filtered(volume, samples, radius, threads); });
}

}  // namespace deliso
