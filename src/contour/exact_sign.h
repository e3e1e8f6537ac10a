// SPDX-License-Identifier: MIT
// Signs of polynomials in a voxel's values minus kappa, exact behind a floating-point filter.
//
// A polynomial is written once, as a generic lambda of the values. Here c(m) is the value at corner
// m minus kappa, d(m) the difference along z between corner m + 4 and corner m. Doubles with an
// error bound evaluate it first. If they cannot decide the sign, expansions (exact/expansion.h)
// evaluate it exactly. Both use the samples and kappa as given, so that not even the rounding of
// value - kappa decides a sign.
//
// Guarantee for polynomials of degree 4 at most. The sign is exact if the highest and the lowest
// nonzero bits of the values and kappa are less than 500 binary places apart. That holds for all
// integer and float32 samples, if kappa is not below 2^-300, and for float64 samples over 130
// decimal magnitudes. Beyond that, signs may be wrong, but the same values give the same sign.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "exact/expansion.h"
#include "volume/volume.h"

namespace deliso {

// A voxel's values, and the values minus kappa, rounded. The rounding keeps every sign.
struct VoxelValues {
  VoxelValues(const Corners& values, double isovalue) : value(values), kappa(isovalue) {
    for (int m = 0; m < 8; ++m) above[m] = value[m] - kappa;
  }

  Corners value;
  double kappa;
  Corners above;
};

// A double and the sum of the magnitudes that went into it. The exact number differs from `value`
// by less than kRounding * size. Leaves have relative errors of u = 2^-53, and every operation adds
// one u. In the discriminant of a saddle at most 12 operations lie between a leaf and the result.
struct Bounded {
  static constexpr double kRounding = 1e-14;
  // A smaller product may have lost bits, so nothing is known about it.
  static constexpr double kUnderflow = 1e-290;

  double value, size;

  explicit Bounded(double v) : value(v), size(std::abs(v)) {}
  Bounded(double v, double s) : value(v), size(s) {}

  std::optional<int> sign() const {
    if (std::abs(value) > kRounding * size) return value > 0 ? 1 : -1;
    if (size == 0) return 0;
    return std::nullopt;
  }

  friend Bounded operator+(Bounded a, Bounded b) { return {a.value + b.value, a.size + b.size}; }
  friend Bounded operator-(Bounded a, Bounded b) { return {a.value - b.value, a.size + b.size}; }
  friend Bounded operator*(Bounded a, Bounded b) {
    const double product = a.size * b.size;
    const bool lost = product < kUnderflow && a.size != 0 && b.size != 0;
    return {a.value * b.value, lost ? std::numeric_limits<double>::infinity() : product};
  }
  friend Bounded operator*(Bounded a, double b) { return a * Bounded(b); }
};

class BoundedValues {
 public:
  explicit BoundedValues(const VoxelValues& v) : v_(v) {}
  Bounded c(int m) const { return Bounded(v_.above[m]); }
  Bounded d(int m) const { return Bounded(v_.value[m + 4] - v_.value[m]); }

 private:
  const VoxelValues& v_;
};

// The values scaled by a power of two, which changes no sign. Products of four then neither
// overflow nor underflow.
class ExactValues {
 public:
  // Scales by the corners whose bits are set in `corners`.
  ExactValues(const VoxelValues& v, int corners) : value_(v.value), kappa_(v.kappa) {
    constexpr int kHighestBit = 240;
    double largest = std::abs(kappa_);
    for (int m = 0; m < 8; ++m) {
      if ((corners >> m & 1) != 0) largest = std::max(largest, std::abs(value_[m]));
    }
    if (largest == 0) return;
    const int shift = kHighestBit - std::ilogb(largest);
    for (double& value : value_) value = std::ldexp(value, shift);
    kappa_ = std::ldexp(kappa_, shift);
  }

  Expansion<2> c(int m) const { return Expansion<2>(two_sum(value_[m], -kappa_)); }
  Expansion<2> d(int m) const { return Expansion<2>(two_sum(value_[m + 4], -value_[m])); }

 private:
  Corners value_;
  double kappa_;
};

// Returns the sign of a polynomial in the corners whose bits are set.
template <class Polynomial>
int sign_of(const VoxelValues& v, int corners, Polynomial&& polynomial) {
  if (const auto sign = polynomial(BoundedValues(v)).sign()) return *sign;
  return polynomial(ExactValues(v, corners)).sign();
}

}  // namespace deliso
