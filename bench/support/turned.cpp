// SPDX-License-Identifier: MIT
#include "support/turned.h"

#include <array>
#include <cstddef>
#include <vector>

namespace deliso {
namespace {

// Axis `a` of the turned volume is axis `from[a]` of the other, backwards if `flipped[a]`.
struct Turn {
  std::array<int, 3> from;
  std::array<bool, 3> flipped;
};

Turn turn_of(std::uint64_t n) {
  constexpr std::array<std::array<int, 3>, 6> kAxes{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  const std::size_t axes = n % kAxes.size();
  const bool exchanges_two = axes >= 3;  // a mirror image, unless an odd number of axes is flipped
  const bool x = (n / kAxes.size() & 1) != 0, y = (n / kAxes.size() & 2) != 0;
  return {kAxes[axes], {x, y, (x != y) != exchanges_two}};
}

}  // namespace

Volume turned(const Volume& volume, std::uint64_t n) {
  const Turn turn = turn_of(n);
  const Index3 before = volume.dims();
  Index3 dims;
  Vec3 spacing;
  for (int a = 0; a < 3; ++a) {
    const int from = turn.from[static_cast<std::size_t>(a)];
    dims[a] = before[from];
    spacing[a] = volume.spacing()[from];
  }
  return volume.visit([&]<class Sample>(const Sample* samples) {
    std::vector<Sample> out;
    out.reserve(volume.sample_count());
    for_each_place({}, dims + Index3{-1, -1, -1}, [&](Index3 at) {
      Index3 of;
      for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        of[turn.from[axis]] = turn.flipped[axis] ? dims[a] - 1 - at[a] : at[a];
      }
      out.push_back(samples[volume.index(of.i, of.j, of.k)]);
    });
    return Volume::from_samples(dims, spacing, out);
  });
}

}  // namespace deliso
