// SPDX-License-Identifier: MIT
#include "delaunay/hilbert.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/box3.h"
#include "base/random.h"

namespace deliso {

namespace {

// The state of Skilling's algorithm (2004, "Programming the Hilbert curve"). It processes whole
// coordinates, level by level from the highest bits. If an axis has the level's bit, the first axis
// is inverted below it; otherwise the two are swapped there. A Gray code follows. So the levels
// above affect a level only by the order of the axes, the inversions and the Gray code's parity.
struct HilbertState {
  std::array<std::uint8_t, 3> axis = {0, 1, 2};
  std::array<bool, 3> is_inverted = {};
  bool is_odd = false;
  friend constexpr bool operator==(const HilbertState&, const HilbertState&) = default;
};

// For each such state and each octant: the three bits of the index and the state of the level
// below. An octant is the bits of x, y, z at a level, x the lowest. State 0 is that of the highest
// level.
struct HilbertTable {
  struct Step {
    std::uint8_t digit, next;
  };
  static constexpr int kMaxStates = 6 * 8 * 2;
  std::array<std::array<Step, 8>, kMaxStates> steps{};

  constexpr HilbertTable() {
    std::array<HilbertState, kMaxStates> states{};
    std::uint8_t count = 1;
    for (std::uint8_t s = 0; s < count; ++s) {
      for (unsigned octant = 0; octant < 8; ++octant) {
        HilbertState below = states[s];
        std::array<bool, 3> bit{};
        for (std::size_t i = 0; i < 3; ++i)
          bit[i] = (octant >> below.axis[i] & 1) ^ below.is_inverted[i];
        for (std::size_t i = 0; i < 3; ++i) {
          if (bit[i]) {
            below.is_inverted[0] ^= 1;
          } else {
            std::swap(below.axis[0], below.axis[i]);
            std::swap(below.is_inverted[0], below.is_inverted[i]);
          }
        }
        const bool g0 = bit[0], g1 = g0 ^ bit[1], g2 = g1 ^ bit[2], odd = below.is_odd;
        below.is_odd ^= g2;
        std::uint8_t next = 0;
        while (next < count && !(states[next] == below)) ++next;
        if (next == count) states[count++] = below;
        steps[s][octant] = {
            static_cast<std::uint8_t>((g0 ^ odd) << 2 | (g1 ^ odd) << 1 | (g2 ^ odd)), next};
      }
    }
  }
};
constexpr HilbertTable kHilbert;

}  // namespace

std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits) {
  std::uint64_t index = 0;
  std::uint8_t state = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    const unsigned octant = (x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
    const auto [digit, next] = kHilbert.steps[state][octant];
    index = index << 3 | digit;
    state = next;
  }
  return index;
}

std::vector<std::uint32_t> biased_hilbert_order(std::span<const Vec3> points) {
  // Each point goes to the last round with probability 7/8, else to the one before with 7/8, and so
  // on.
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
