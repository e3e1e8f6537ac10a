// SPDX-License-Identifier: MIT
#include "io/volume/even_volume.h"

#include <algorithm>
#include <cstring>

#include "base/text.h"
#include "io/volume/dicom_slices.h"

namespace deliso {
namespace {

// Writes the samples between two slices: a share of 0 gives the first one's, 1 the second one's.
template <class Real, class T>
void interpolate_slices(const T* first, const T* second, double share, std::size_t count,
                        std::byte* out) {
  for (std::size_t n = 0; n < count; ++n, out += sizeof(Real)) {
    const Real value = static_cast<Real>((1 - share) * static_cast<double>(first[n]) +
                                         share * static_cast<double>(second[n]));
    std::memcpy(out, &value, sizeof value);
  }
}

}  // namespace

Volume resampled_evenly(const VolumeInput& input, SampleGrid grid,
                        const std::vector<double>& places, const Volume& slices) {
  grid.type = type_of_interpolated(slices.type());
  const bool is_small = grid.type == SampleType::f32;
  double least = places[1] - places[0], most = least;
  for (std::size_t n = 2; n < places.size(); ++n) {
    least = std::min(least, places[n] - places[n - 1]);
    most = std::max(most, places[n] - places[n - 1]);
  }
  const double step = length(grid.steps[2]);
  input.note("slices-uneven", "slices are uneven, from ", rounded_length(least * step), " to ",
             rounded_length(most * step), " apart: they are interpolated in even steps of ",
             rounded_length(step), ", as ", name_of(grid.type));
  const Index3 dims = slices.dims();
  const std::size_t area = static_cast<std::size_t>(dims.i) * static_cast<std::size_t>(dims.j);
  return volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
    const double at = static_cast<double>(k);
    const auto next = std::upper_bound(places.begin() + 1, places.end() - 1, at);
    const double before = *(next - 1);
    const double share = std::clamp((at - before) / (*next - before), 0.0, 1.0);
    const std::size_t first = static_cast<std::size_t>(next - places.begin() - 1) * area;
    slices.visit([&](const auto* samples) {
      const auto* from = samples + first;
      if (is_small) interpolate_slices<float>(from, from + area, share, area, out.data());
      if (!is_small) interpolate_slices<double>(from, from + area, share, area, out.data());
    });
  });
}

}  // namespace deliso
