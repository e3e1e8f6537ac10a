// SPDX-License-Identifier: MIT
// The oracle of the predicate tests: integers of up to 41,000 bits, and determinants of doubles
// read as integers over a common power of two. School arithmetic; it shares nothing with src/.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>

#include "base/vec3.h"

namespace deliso::oracle {

__extension__ typedef unsigned __int128 Wide;

// Sign and magnitude, least significant limb first, no leading zero limbs; 0 has none.
class BigInt {
 public:
  static constexpr int kMaxLimbs = 640;

  BigInt() {}
  explicit BigInt(std::int64_t v) : negative_(v < 0) {
    push(negative_ ? 0 - static_cast<std::uint64_t>(v) : static_cast<std::uint64_t>(v));
    trim();
  }

  // Copies the limbs in use only.
  BigInt(const BigInt& b) : size_(b.size_), negative_(b.negative_) {
    std::copy_n(b.limb_.begin(), b.size_, limb_.begin());
  }
  BigInt& operator=(const BigInt& b) {
    size_ = b.size_;
    negative_ = b.negative_;
    std::copy_n(b.limb_.begin(), b.size_, limb_.begin());
    return *this;
  }

  int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  BigInt shifted_left(int bits) const {
    BigInt r;
    r.negative_ = negative_;
    for (int i = 0; i < bits / 64; ++i) r.push(0);
    const int rest = bits % 64;
    Wide carry = 0;
    for (int i = 0; i < size_; ++i) {
      carry |= static_cast<Wide>(limb_[i]) << rest;
      r.push(static_cast<std::uint64_t>(carry));
      carry >>= 64;
    }
    r.push(static_cast<std::uint64_t>(carry));
    r.trim();
    return r;
  }

  // The nearest value of the widest floating type, over 2^bits.
  long double divided_by_power(int bits) const {
    long double sum = 0;
    for (int i = size_ - 1; i >= 0 && i >= size_ - 2; --i)
      sum += std::ldexp(static_cast<long double>(limb_[i]), 64 * i - bits);
    return negative_ ? -sum : sum;
  }

  friend BigInt operator-(BigInt a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend BigInt operator+(const BigInt& a, const BigInt& b) {
    BigInt r;
    if (a.negative_ == b.negative_) {
      r = sum_of_magnitudes(a, b);
      r.negative_ = a.negative_;
    } else if (magnitude_less(a, b)) {
      r = difference_of_magnitudes(b, a);
      r.negative_ = b.negative_;
    } else {
      r = difference_of_magnitudes(a, b);
      r.negative_ = a.negative_;
    }
    return r;
  }
  friend BigInt operator-(const BigInt& a, const BigInt& b) { return a + (-b); }
  friend BigInt operator*(const BigInt& a, const BigInt& b) {
    BigInt r;
    r.negative_ = a.negative_ != b.negative_;
    for (int i = 0; i < a.size_ + b.size_; ++i) r.push(0);
    for (int i = 0; i < a.size_; ++i) {
      Wide carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        carry += static_cast<Wide>(a.limb_[i]) * b.limb_[j] + r.limb_[i + j];
        r.limb_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
      r.limb_[i + b.size_] = static_cast<std::uint64_t>(carry);
    }
    r.trim();
    return r;
  }

 private:
  void push(std::uint64_t limb) {
    if (size_ == kMaxLimbs) std::abort();
    limb_[size_++] = limb;
  }
  void trim() {
    while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
  }
  static bool magnitude_less(const BigInt& a, const BigInt& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (int i = a.size_ - 1; i >= 0; --i)
      if (a.limb_[i] != b.limb_[i]) return a.limb_[i] < b.limb_[i];
    return false;
  }
  static BigInt sum_of_magnitudes(const BigInt& a, const BigInt& b) {
    BigInt r;
    Wide carry = 0;
    for (int i = 0; i < std::max(a.size_, b.size_); ++i) {
      if (i < a.size_) carry += a.limb_[i];
      if (i < b.size_) carry += b.limb_[i];
      r.push(static_cast<std::uint64_t>(carry));
      carry >>= 64;
    }
    if (carry != 0) r.push(static_cast<std::uint64_t>(carry));
    return r;
  }
  // pre: |a| >= |b|
  static BigInt difference_of_magnitudes(const BigInt& a, const BigInt& b) {
    BigInt r;
    std::uint64_t borrow = 0;
    for (int i = 0; i < a.size_; ++i) {
      const Wide taken = Wide{i < b.size_ ? b.limb_[i] : 0} + borrow;
      r.push(a.limb_[i] - static_cast<std::uint64_t>(taken));
      borrow = a.limb_[i] < taken;
    }
    r.trim();
    return r;
  }

  std::array<std::uint64_t, kMaxLimbs> limb_;
  int size_ = 0;
  bool negative_ = false;
};

// x as odd * 2^exponent, read from its bits. pre: x is finite and not 0.
struct OddPart {
  std::int64_t odd;
  int exponent;
};

inline OddPart odd_part(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int field = static_cast<int>(bits >> 52 & 2047);
  const std::uint64_t mantissa = (bits & ((1ull << 52) - 1)) | (field > 0 ? 1ull << 52 : 0);
  const int zeros = std::countr_zero(mantissa);
  const auto odd = static_cast<std::int64_t>(mantissa >> zeros);
  return {x < 0 ? -odd : odd, std::max(field, 1) - 1075 + zeros};
}

inline int lowest_exponent(double x, int if_zero) {
  return x == 0 ? if_zero : odd_part(x).exponent;
}

// x / 2^unit. pre: that is an integer.
inline BigInt to_integer(double x, int unit) {
  if (x == 0) return BigInt();
  const OddPart p = odd_part(x);
  return BigInt(p.odd).shifted_left(p.exponent - unit);
}

struct BigVec3 {
  BigInt x, y, z;
  friend BigVec3 operator-(const BigVec3& a, const BigVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend BigInt dot(const BigVec3& a, const BigVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend BigVec3 cross(const BigVec3& a, const BigVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

// The largest exponent that divides all coordinates: the unit of to_integers.
inline int common_unit(std::initializer_list<Vec3> points) {
  constexpr int kNone = 100000;
  int unit = kNone;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) unit = std::min(unit, lowest_exponent(p[axis], kNone));
  return unit == kNone ? 0 : unit;
}

inline BigVec3 to_integers(const Vec3& p, int unit) {
  return {to_integer(p.x, unit), to_integer(p.y, unit), to_integer(p.z, unit)};
}

// det[b-a, c-a, d-a] in units of 2^(3 unit).
inline BigInt orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int unit) {
  const BigVec3 o = to_integers(a, unit);
  const BigVec3 u = to_integers(b, unit) - o, v = to_integers(c, unit) - o,
                w = to_integers(d, unit) - o;
  return dot(u, cross(v, w));
}

inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return orient3d(a, b, c, d, common_unit({a, b, c, d})).sign();
}

// By lifting from a, so that it shares no formula with the code under test: e is inside if the
// lifted e lies below the hyperplane of the others.
inline int insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  const int unit = common_unit({a, b, c, d, e});
  const BigVec3 o = to_integers(a, unit);
  const BigVec3 u = to_integers(b, unit) - o, v = to_integers(c, unit) - o,
                w = to_integers(d, unit) - o, x = to_integers(e, unit) - o;
  // With orientation det = det[u, v, w] and 2 det center = n: |x|^2 < 2 center.x, times det.
  const BigInt det = dot(u, cross(v, w));
  const BigInt u2 = dot(u, u), v2 = dot(v, v), w2 = dot(w, w);
  const BigVec3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const BigInt nx = u2 * dot(vw, x) + v2 * dot(wu, x) + w2 * dot(uv, x);
  return (nx - det * dot(x, x)).sign();
}

}  // namespace deliso::oracle
