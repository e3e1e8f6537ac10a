// SPDX-License-Identifier: MIT
#include "delaunay/hilbert.h"

#include <algorithm>
#include <bit>

#include "base/box3.h"
#include "base/random.h"

namespace deliso {

// Skilling 2004, "Programming the Hilbert curve".
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits) {
  std::uint32_t axis[3] = {x, y, z};

  // Undo the rotations and reflections of each level. Where an axis has the level's bit, the first
  // axis is inverted below it, else the two are swapped there; masks, since no processor can
  // predict random bits.
  for (int bit = bits - 1; bit > 0; --bit) {
    const std::uint32_t below = (1u << bit) - 1;
    for (std::uint32_t& a : axis) {
      const std::uint32_t invert = below & (0 - (a >> bit & 1));
      const std::uint32_t swap = (axis[0] ^ a) & (below ^ invert);
      axis[0] ^= invert | swap;
      a ^= swap;
    }
  }

  // Gray encode.
  axis[1] ^= axis[0];
  axis[2] ^= axis[1];
  std::uint32_t t = 0;
  for (int bit = bits - 1; bit > 0; --bit) t ^= ((1u << bit) - 1) & (0 - (axis[2] >> bit & 1));
  for (std::uint32_t& a : axis) a ^= t;

  // Interleave, highest bits first.
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (std::uint32_t a : axis) index = index << 1 | (a >> bit & 1);
  return index;
}

std::vector<std::uint32_t> biased_hilbert_order(std::span<const Vec3> points) {
  // Each point goes to the last round with probability 7/8, else to the one before with 7/8, ...
  constexpr int kRounds = 16, kBits = 20;
  static_assert(3 * kBits + std::bit_width(unsigned{kRounds - 1}) <= 64);
  if (points.empty()) return {};

  Box3 box{points[0], points[0]};
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
  }
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
