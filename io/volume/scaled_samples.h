// SPDX-License-Identifier: MIT
// Samples whose file gives a slope and an intercept: a value is slope * sample + intercept.
#pragma once

#include <cstddef>
#include <cstring>

#include "io/volume/volume_formats.h"
#include "volume/volume.h"

namespace deliso {

// Writes the values of `count` samples, computed in double and rounded once.
template <class Real, class T>
void write_scaled(const T* samples, std::size_t count, double slope, double intercept,
                  std::byte* out) {
  for (std::size_t n = 0; n < count; ++n) {
    const Real value = static_cast<Real>(slope * static_cast<double>(samples[n]) + intercept);
    std::memcpy(out + n * sizeof(Real), &value, sizeof value);
  }
}

// Returns the volume of the values, and notes it: float32 from types of up to 16 bits and float32,
// else float64. pre: slope and intercept are finite.
Volume scaled_volume(const VolumeInput& input, const Volume& volume, double slope,
                     double intercept);

}  // namespace deliso
