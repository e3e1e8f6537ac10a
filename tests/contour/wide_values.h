// SPDX-License-Identifier: MIT
// Voxels and small volumes whose topology depends on the last bits: values over magnitudes, and
// saddles at kappa or next to it.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "volume/volume.h"

namespace deliso {

enum class WideKind : std::uint8_t {
  magnitudes,  // 10^-12 to 10^12, either sign, all bits random
  half_way,    // small integers, kappa half-way between two
  near_ties,   // products of few factors, so that saddles are equal or differ in the last bits
};
inline constexpr int kWideKinds = 3;

struct WideValues {
  std::vector<double> samples;
  double kappa;
};

inline WideValues make_wide_values(Random& random, WideKind kind, std::size_t count) {
  WideValues wide{{}, 0};
  const auto sign = [&] { return random.below(2) != 0 ? 1.0 : -1.0; };
  const auto magnitude = [&] { return std::exp(random.uniform(-27.6, 27.6)); };
  const std::uint32_t levels = 2 + random.below(12);
  for (std::size_t n = 0; n < count; ++n) {
    double v = 0;
    switch (kind) {
      case WideKind::magnitudes:
        v = sign() * magnitude();
        break;
      case WideKind::half_way:
        v = random.below(levels);
        break;
      case WideKind::near_ties:
        v = sign() * std::ldexp(1 + 2 * static_cast<double>(random.below(3)),
                                static_cast<int>(random.below(3)));
        if (random.below(4) == 0) v *= 1 + 0x1p-52 * random.below(3);
        break;
    }
    wide.samples.push_back(v);
  }
  if (kind == WideKind::magnitudes && random.below(2) != 0) {
    wide.kappa = random.below(4) == 0
                     ? wide.samples[random.below(static_cast<std::uint32_t>(count))]
                     : sign() * magnitude();
  }
  if (kind == WideKind::half_way) wide.kappa = random.below(levels - 1) + 0.5;
  // A kappa for which no difference from it is a double.
  if (kind == WideKind::near_ties && random.below(2) != 0) wide.kappa = 0x1p-60 * random.below(9);
  return wide;
}

}  // namespace deliso
