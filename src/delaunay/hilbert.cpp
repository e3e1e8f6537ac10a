// SPDX-License-Identifier: MIT
#include "delaunay/hilbert.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/box3.h"
#include "base/random.h"

namespace deliso {

// Skilling's algorithm (2004, "Programming the Hilbert curve") on whole coordinates, level by level
// from the highest bits. If an axis has the level's bit, the first axis is inverted below it;
// otherwise the two are swapped there. A Gray code over axes and levels follows.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits) {
  std::array<std::uint32_t, 3> axes{x, y, z};
  const std::uint32_t highest = std::uint32_t{1} << (bits - 1);
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1) {
    for (std::uint32_t& axis : axes) {
      const bool has_bit = (axis & bit) != 0;
      const std::uint32_t swapped = has_bit ? 0 : (axes[0] ^ axis) & (bit - 1);
      axes[0] ^= has_bit ? bit - 1 : swapped;
      axis ^= swapped;
    }
  }
  axes[1] ^= axes[0];
  axes[2] ^= axes[1];
  std::uint32_t odd = 0;  // levels below an odd number of bits of the last axis
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1) {
    if ((axes[2] & bit) != 0) odd ^= bit - 1;
  }
  std::uint64_t index = 0;
  for (int level = bits - 1; level >= 0; --level) {
    for (const std::uint32_t axis : axes) index = index << 1 | ((axis ^ odd) >> level & 1);
  }
  return index;
}

std::vector<std::uint32_t> biased_hilbert_order(std::span<const Vec3> points) {
  // Each point goes to the last round with probability 7/8, else to the one before with 7/8, and so
  // on.
  constexpr int kRounds = 16, kBits = 20;
  static_assert(3 * kBits + std::bit_width(unsigned{kRounds - 1}) <= 64);
  if (points.empty()) return {};

  const Box3 box = box_of(points);
  const double side = std::max({box.size().x, box.size().y, box.size().z});
  const auto grid = [&](double offset) {
    const double scaled = side > 0 ? offset / side * (1 << kBits) : 0;
    return static_cast<std::uint32_t>(std::min(scaled, double{(1 << kBits) - 1}));
  };

  struct Place {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Place> places(points.size());
  Random random(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 q = points[i] - box.lo;
    const int early = std::countl_zero(random.next()) / 3;
    const std::uint64_t round = static_cast<std::uint64_t>(std::max(kRounds - 1 - early, 0));
    places[i] = {round << (3 * kBits) | hilbert_index(grid(q.x), grid(q.y), grid(q.z), kBits), i};
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  std::vector<std::uint32_t> order(points.size());
  std::transform(places.begin(), places.end(), order.begin(),
                 [](const Place& p) { return p.index; });
  return order;
}

}  // namespace deliso
