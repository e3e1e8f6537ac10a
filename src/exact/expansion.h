// SPDX-License-Identifier: MIT
// Exact arithmetic on sums of doubles (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic
// and Fast Robust Geometric Predicates"; Dekker 1971; Knuth 1969).
//
// An Expansion is the exact sum of its terms. Every routine keeps X1 to X3, given round-to-even and
// neither overflow nor underflow. (predicates.h says for which coordinates that holds.)
//   X1  Terms grow in magnitude, and no bit of one lies below the top bit of a smaller one
//       ("strongly nonoverlapping"). So the last term has the sign of the sum.
//   X2  No term is zero; the empty expansion is 0.
//   X3  The type has the bound N on the number of terms, which follows from the operation. A sum of
//       M and N terms appends at most M + N, a product by a double at most 2 N. Their loops alone
//       guarantee it, for NaN and infinities too. A product of M and N terms has 2 M N.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>

#include "base/check.h"

namespace deliso {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::radix == 2);
static_assert(FLT_EVAL_METHOD == 0, "doubles must not be held in wider registers");

// value + error is exact; value is the rounded result of the operation.
struct TwoTerms {
  double value, error;
};

// Return the exact sum of a and b.
inline TwoTerms two_sum(double a, double b) {
  const double sum = a + b;
  const double b_seen = sum - a, a_seen = sum - b_seen;
  return {sum, (a - a_seen) + (b - b_seen)};
}

// pre: a is 0 or |a| >= |b|.
inline TwoTerms fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// high + low == a, each with at most half of the 53 bits, so their products are exact.
struct Halves {
  double high, low;
};

inline Halves split(double a) {
  constexpr int kHalfBits = (std::numeric_limits<double>::digits + 1) / 2;
  constexpr double kSplitter = static_cast<double>((1LL << kHalfBits) + 1);
  const double c = kSplitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

// Return the exact product of a and b.
inline TwoTerms two_product(double a, double b, Halves b_halves) {
  const double product = a * b;
  const Halves a_halves = split(a);
  const double rest = ((product - a_halves.high * b_halves.high) - a_halves.low * b_halves.high) -
                      a_halves.high * b_halves.low;
  return {product, a_halves.low * b_halves.low - rest};
}

inline TwoTerms two_product(double a, double b) {
  return two_product(a, b, split(b));
}

template <int N>
class Expansion {
 public:
  // Leaves the terms from size() on uninitialized: the longest types fill tens of kilobytes.
  Expansion() {}  // NOLINT(modernize-use-equals-default)
  explicit Expansion(TwoTerms t) requires(N >= 2) {
    append(t.error);
    append(t.value);
  }

  // Copies size() terms only.
  Expansion(const Expansion& e) : size_(e.size_) {
    std::copy_n(e.term_.begin(), e.size_, term_.begin());
  }
  Expansion& operator=(const Expansion&) = delete;

  int size() const { return size_; }
  void clear() { size_ = 0; }
  double operator[](int i) const { return term_[i]; }
  int sign() const {
    if (size_ == 0) return 0;
    return term_[size_ - 1] > 0 ? 1 : -1;
  }
  // Returns the sum, rounded a few times: relative error below 2 epsilon by X1.
  double estimate() const {
    double sum = 0;
    for (int i = 0; i < size_; ++i) sum += term_[i];
    return sum;
  }

  // Appends the next larger term; drops zeros (X2).
  void append(double term) {
    if (term == 0) return;
    DELISO_CHECK(size_ < N);
    term_[size_++] = term;
  }

 private:
  std::array<double, N> term_;
  int size_ = 0;
};

template <int N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> h;
  for (int i = 0; i < e.size(); ++i) h.append(-e[i]);
  return h;
}

// Sets h = e + f by Shewchuk's fast expansion sum: merge by magnitude, then carry upwards.
template <int L, int M, int N>
void add(const Expansion<M>& e, const Expansion<N>& f, Expansion<L>& h) {
  h.clear();
  int i = 0, j = 0;
  const auto smallest_left = [&] {
    const bool from_e = j == f.size() || (i < e.size() && std::fabs(e[i]) < std::fabs(f[j]));
    return from_e ? e[i++] : f[j++];
  };
  const int count = e.size() + f.size();
  if (count == 0) return;
  double carry = smallest_left();
  for (int k = 1; k < count; ++k) {
    const TwoTerms s = two_sum(carry, smallest_left());
    h.append(s.error);
    carry = s.value;
  }
  h.append(carry);
}

template <int M, int N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<M + N> h;
  add(e, f, h);
  return h;
}

template <int M, int N>
Expansion<M + N> operator-(const Expansion<M>& e, const Expansion<N>& f) {
  return e + (-f);
}

// Returns e * b, by Shewchuk's scale expansion.
template <int N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b) {
  Expansion<2 * N> h;
  if (e.size() == 0) return h;
  const Halves halves = split(b);
  const TwoTerms first = two_product(e[0], b, halves);
  h.append(first.error);
  double carry = first.value;
  for (int i = 1; i < e.size(); ++i) {
    const TwoTerms p = two_product(e[i], b, halves);
    const TwoTerms low = two_sum(carry, p.error);
    h.append(low.error);
    const TwoTerms high = fast_two_sum(p.value, low.value);
    h.append(high.error);
    carry = high.value;
  }
  h.append(carry);
  return h;
}

// Returns e * f, term by term of f.
template <int M, int N>
Expansion<2 * M * N> operator*(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<2 * M * N> sum, other;
  for (int j = 0; j < f.size(); ++j) {
    if (j % 2 == 0) {
      add(sum, e * f[j], other);
    } else {
      add(other, e * f[j], sum);
    }
  }
  return f.size() % 2 == 0 ? sum : other;
}

// Returns a * d - b * c.
inline Expansion<4> determinant(double a, double b, double c, double d) {
  return Expansion<2>(two_product(a, d)) - Expansion<2>(two_product(b, c));
}

}  // namespace deliso
