// SPDX-License-Identifier: MIT
// JPEG-LS (ITU-T T.87, annexes A and F). A sample is predicted from its neighbors, left (a), above
// (b), above to the left (c) and to the right (d). The three differences between them choose one of
// 365 contexts. Each learns the mean of its errors, which corrects the prediction, and their size,
// which chooses a Golomb code. Where the differences vanish, the length of a run is coded.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <vector>

#include "io/files/jpeg_scan.h"

namespace deliso {
namespace {

constexpr int kRunOrders[32] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,  2,  3,  3,  3,  3,
                                4, 4, 5, 5, 6, 6, 7, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr std::size_t kRegular = 365;  // contexts; two more are for the samples that end a run

int bit_width(int n) {
  return 32 - std::countl_zero(static_cast<std::uint32_t>(n));
}

class JpegLsDecoder {
 public:
  explicit JpegLsDecoder(JpegScan& scan) : scan_(scan), near_(scan.selection) {}

  const char* run() {
    if (!set_parameters()) return "impossible parameters";
    // One sample more on both sides: the neighbors of the first and of the last.
    std::vector<int> above, row;
    for (std::size_t y = 0; y < scan_.rows; ++y) {
      if (!scan_.restart_before(y)) return "no restart marker where one is due";
      if (scan_.starts_at(y)) {
        row.assign(scan_.columns + 2, 0);
        above = row;
        contexts_.fill({std::max(2, (range_ + 32) / 64)});
        run_index_ = 0;
      }
      above[scan_.columns + 1] = above[scan_.columns];
      row[0] = above[1];
      if (!decode_row(above.data(), row.data())) return "an unknown code";
      if (scan_.bits.overrun()) return "an early end";
      std::copy_n(row.begin() + 1, scan_.columns, &scan_.out[y * scan_.columns]);
      above.swap(row);
    }
    return nullptr;
  }

 private:
  struct Context {
    std::int64_t sizes = 0;  // of errors, their sum
    int errors = 0;          // their sum; or, of an end of a run, the number of negative ones
    int correction = 0;
    int count = 1;

    void add(int size, int error, int reset) {
      sizes += size;
      errors += error;
      if (count == reset) sizes >>= 1, errors >>= 1, count >>= 1;
      ++count;
    }
  };

  // Takes the defaults of T.87 (C.2.4.1.1) where the scan has 0. Returns false for impossible
  // values.
  bool set_parameters() {
    largest_ = scan_.preset[0] > 0 ? scan_.preset[0] : (1 << scan_.sample_bits) - 1;
    reset_ = scan_.preset[4] > 0 ? scan_.preset[4] : 64;
    if (largest_ >> scan_.sample_bits > 0 || near_ > std::min(255, largest_ / 2) || reset_ < 3 ||
        reset_ > std::max(255, largest_)) {
      return false;
    }
    const bool is_wide = largest_ >= 128;
    const int factor = is_wide ? (std::min(largest_, 4095) + 128) / 256 : 256 / (largest_ + 1);
    constexpr std::array<int, 3> kBases{3, 7, 21};
    int least = near_ + 1;
    for (std::size_t n = 0; n < 3; least = thresholds_[n++]) {
      const int base = kBases[n], offset = static_cast<int>(2 + n), given = scan_.preset[n + 1];
      const int errors = (2 * offset - 1) * near_;
      const int usual = is_wide ? factor * (base - offset) + offset + errors
                                : std::max(offset, base / factor + errors);
      thresholds_[n] = given > 0 ? given : usual > largest_ ? least : std::max(least, usual);
    }
    step_ = 2 * near_ + 1;
    range_ = (largest_ + 2 * near_) / step_ + 1;
    range_bits_ = bit_width(range_ - 1);
    const int bits = std::max(2, bit_width(largest_));
    limit_ = 2 * (bits + std::max(8, bits));
    return true;
  }

  // Returns the region of a difference, -4 to 4.
  int region(int difference) const {
    const int size = std::abs(difference);
    if (size <= near_) return 0;
    const int n =
        1 + (size >= thresholds_[0]) + (size >= thresholds_[1]) + (size >= thresholds_[2]);
    return difference < 0 ? -n : n;
  }

  // Rows begin at index 1. Returns false if there is an unknown code.
  bool decode_row(const int* above, int* row) {
    for (std::size_t x = 1; x <= scan_.columns; ++x) {
      const int a = row[x - 1], b = above[x], c = above[x - 1], d = above[x + 1];
      const int q = 81 * region(d - b) + 9 * region(b - c) + region(c - a);
      if (q == 0) {
        if (!decode_run(above, row, x)) return false;
        continue;
      }
      Context& context = contexts_[static_cast<std::size_t>(std::abs(q))];
      const int sign = q < 0 ? -1 : 1;
      const int median = std::max(std::min(a, b), std::min(std::max(a, b), a + b - c));
      const int predicted = std::clamp(median + sign * context.correction, 0, largest_);
      const unsigned k = golomb_order(context.sizes, context.count);
      const int number = golomb(k, limit_);
      if (number < 0) return false;
      int error = number % 2 == 0 ? number / 2 : -(number + 1) / 2;
      if (near_ == 0 && k == 0 && 2 * context.errors <= -context.count) error = -1 - error;
      row[x] = reconstructed(predicted, sign * error);
      context.add(std::abs(error), error * step_, reset_);
      if (context.errors <= -context.count) {
        context.errors = std::max(context.errors + context.count, 1 - context.count);
        context.correction = std::max(context.correction - 1, -128);
      } else if (context.errors > 0) {
        context.errors = std::min(context.errors - context.count, 0);
        context.correction = std::min(context.correction + 1, 127);
      }
    }
    return true;
  }

  // Returns the k of the Golomb code for errors of a mean size.
  static unsigned golomb_order(std::int64_t sizes, int count) {
    unsigned k = 0;
    while (std::int64_t{count} << k < sizes) ++k;
    return k;
  }

  // Returns a number in a Golomb code of at most `limit` bits, or -1.
  int golomb(unsigned k, int limit) {
    scan_.bits.refill();
    const int zeros = static_cast<int>(scan_.bits.zeros()), most = limit - range_bits_ - 1;
    if (zeros > most) return -1;
    scan_.bits.skip(static_cast<unsigned>(zeros + 1));
    scan_.bits.refill();
    const bool is_plain = zeros == most;  // after as many zeros the number follows as it is
    const unsigned low = scan_.bits.take(is_plain ? static_cast<unsigned>(range_bits_) : k);
    const int number = static_cast<int>(low) + (is_plain ? 1 : zeros << k);
    return number > 2 * range_ ? -1 : number;  // keeps k and all sums small
  }

  // Decodes a run from x on and the sample behind it, if the row has one. Moves x to the last.
  bool decode_run(const int* above, int* row, std::size_t& x) {
    const int a = row[x - 1];
    for (bool goes_on = true; goes_on;) {
      scan_.bits.refill();
      goes_on = scan_.bits.take(1) == 1;
      const unsigned order = static_cast<unsigned>(kRunOrders[run_index_]);
      const std::size_t left = scan_.columns + 1 - x, whole = std::size_t{1} << order;
      const std::size_t count = goes_on ? std::min(left, whole) : scan_.bits.take(order);
      if (!goes_on && count >= left) return false;
      std::fill_n(row + x, count, a);
      x += count;
      if (goes_on && whole <= left) run_index_ = std::min<std::size_t>(run_index_ + 1, 31);
      if (count == left) return --x, true;
    }
    const int b = above[x];
    const int alike = std::abs(a - b) <= near_ ? 1 : 0;
    Context& context = contexts_[kRegular + static_cast<std::size_t>(alike)];
    const unsigned k = golomb_order(context.sizes + (alike ? context.count / 2 : 0), context.count);
    const int number = golomb(k, limit_ - kRunOrders[run_index_] - 1);
    if (number < 0) return false;
    const int odd = (number + alike) % 2, size = (number + alike + odd) / 2;
    const bool is_negative = (k != 0 || 2 * context.errors >= context.count) == (odd == 1);
    context.add((number + 1 - alike) / 2, is_negative && size > 0 ? 1 : 0, reset_);
    if (run_index_ > 0) --run_index_;
    row[x] = reconstructed(alike ? a : b, is_negative == (alike || a <= b) ? -size : size);
    return true;
  }

  // Returns the sample, modulo the range.
  int reconstructed(int predicted, int error) const {
    int sample = predicted + error * step_;
    if (sample < -near_) sample += range_ * step_;
    if (sample > largest_ + near_) sample -= range_ * step_;
    return std::clamp(sample, 0, largest_);
  }

  JpegScan& scan_;
  int near_;
  int largest_ = 0, reset_ = 0, step_ = 1, range_ = 0, range_bits_ = 0, limit_ = 0;
  std::array<int, 3> thresholds_{};
  std::array<Context, kRegular + 2> contexts_;
  std::size_t run_index_ = 0;
};

}  // namespace

const char* decode_jpeg_ls(JpegScan& scan) {
  return JpegLsDecoder(scan).run();
}

}  // namespace deliso
