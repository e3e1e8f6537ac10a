// SPDX-License-Identifier: MIT
#include "io/volume/upright_volume.h"

#include <cmath>
#include <cstring>

#include "base/text.h"

namespace deliso {
namespace {

// Of samples in the grid around all slices, to those of the slices.
constexpr double kLargestGrowth = 4;

// Of a shift, in samples: less is an error of rounding.
constexpr double kShiftError = 1e-6;

// How much each slice is shifted against the one before, in samples along x and y.
std::array<double, 2> shifts_of(const SampleGrid& grid) {
  std::array<double, 2> shifts{};
  const Vec3 step = grid.steps[2];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Vec3 side = grid.steps[axis];
    const double shift = dot(step, side) / length(side);
    if (std::abs(shift) > kShearTolerance * length(step)) shifts[axis] = shift / length(side);
  }
  return shifts;
}

// Writes a slice that is shifted by `shifts`, which are not negative, into one of dims.i x dims.j.
template <class Real, class T>
void shift_slice(const T* slice, Index3 from, const std::array<double, 2>& shifts, double least,
                 Index3 dims, std::byte* out) {
  const int dx = static_cast<int>(std::ceil(shifts[0])),
            dy = static_cast<int>(std::ceil(shifts[1]));
  const double fx = dx - shifts[0], fy = dy - shifts[1];  // from a sample towards the next
  const int last_x = from.i - (fx > 0 ? 1 : 0), last_y = from.j - (fy > 0 ? 1 : 0);
  for (int y = -dy; y < dims.j - dy; ++y) {
    for (int x = -dx; x < dims.i - dx; ++x, out += sizeof(Real)) {
      double value = least;
      if (x >= 0 && y >= 0 && x < last_x && y < last_y) {
        const T* at = slice + x + static_cast<std::ptrdiff_t>(y) * from.i;
        const auto along_x = [&](const T* s) {
          return fx > 0 ? (1 - fx) * static_cast<double>(s[0]) + fx * static_cast<double>(s[1])
                        : static_cast<double>(s[0]);
        };
        value = along_x(at);
        if (fy > 0) value = (1 - fy) * value + fy * along_x(at + from.i);
      }
      const Real rounded = static_cast<Real>(value);
      std::memcpy(out, &rounded, sizeof rounded);
    }
  }
}

}  // namespace

SampleGrid upright_grid(const SampleGrid& grid) {
  const auto shifts = shifts_of(grid);
  SampleGrid upright = grid;
  double growth = 1;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    upright.steps[2] = upright.steps[2] - shifts[axis] * grid.steps[axis];
    growth *= 1 + std::abs(shifts[axis]) * static_cast<double>(grid.dims[2] - 1) /
                      static_cast<double>(grid.dims[axis]);
  }
  return growth <= kLargestGrowth ? upright : grid;
}

Volume resampled_upright(const VolumeInput& input, const SampleGrid& grid, const Volume& slices) {
  const Index3 from = slices.dims();
  const auto shifts = shifts_of(grid);
  SampleGrid upright = upright_grid(grid);
  std::array<double, 2> first{};  // the shift of slice 0 in the grid
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double last = shifts[axis] * (from.k - 1);
    first[axis] = std::max(0.0, -last);
    upright.origin = upright.origin - first[axis] * grid.steps[axis];
    upright.dims[axis] += static_cast<std::int64_t>(std::ceil(std::abs(last) - kShiftError));
  }
  upright.type = type_of_interpolated(slices.type());
  const bool is_small = upright.type == SampleType::f32;
  const double least = value_range(slices, input.name()).min;
  const double cosine = length(upright.steps[2]) / length(grid.steps[2]);
  input.note("slices-tilted",
             "slices are shifted against each other, as by a gantry that is tilted by ",
             std::round(std::acos(std::min(1.0, cosine)) * 1800 / 3.14159265358979) / 10,
             " degrees: they are resampled upright, as ", name_of(upright.type), ", with ", least,
             " beyond their edges");
  const Index3 dims = upright.size();
  return volume_from_slices(upright, [&](std::size_t k, std::span<std::byte> out) {
    const std::size_t begin =
        k * static_cast<std::size_t>(from.i) * static_cast<std::size_t>(from.j);
    std::array<double, 2> own{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      own[axis] = first[axis] + static_cast<double>(k) * shifts[axis];
      const double whole = std::round(own[axis]);
      if (std::abs(own[axis] - whole) < kShiftError) own[axis] = whole;
    }
    slices.visit([&](const auto* samples) {
      if (is_small) shift_slice<float>(samples + begin, from, own, least, dims, out.data());
      if (!is_small) shift_slice<double>(samples + begin, from, own, least, dims, out.data());
    });
  });
}

}  // namespace deliso
