// SPDX-License-Identifier: MIT
// Writes lossless JPEG (ITU-T T.81, annex H) and JPEG-LS (T.87) by the words of the standards:
// neighbors are looked up in the picture, and all is decided sample by sample.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/files/deflate_writer.h"

namespace deliso::test {

struct JpegImage {
  int columns = 0, rows = 0, bits = 8;
  std::vector<int> samples{};

  int at(int x, int y) const { return samples[static_cast<std::size_t>(x + y * columns)]; }
};

struct JpegForm {
  bool is_ls = false;
  int predictor = 1;        // JPEG
  int point_transform = 0;  // JPEG: the encoder shifts samples to the right
  bool has_long_codes = false;
  int near = 0;                 // JPEG-LS
  std::array<int, 5> preset{};  // JPEG-LS: MAXVAL, T1, T2, T3, RESET
  int restart_rows = 0;         // 0: no restarts
};

// Bits, the highest first, stuffed as the standard says.
class JpegBitWriter {
 public:
  JpegBitWriter(std::string& out, bool is_ls) : out_(out), is_ls_(is_ls) {}
  void put(std::uint64_t value, int count) {
    while (count-- > 0) {
      byte_ = byte_ << 1 | (value >> count & 1);
      if (++used_ == room_) flush_byte();
    }
  }
  // Fills the last byte: JPEG with ones, JPEG-LS with zeros.
  void end() {
    while (used_ > 0 || room_ == 7) put(is_ls_ ? 0 : 1, 1);
  }

 private:
  void flush_byte() {
    out_ += static_cast<char>(byte_);
    const bool is_ones = byte_ == 0xff;
    if (is_ones && !is_ls_) out_ += '\0';
    room_ = is_ones && is_ls_ ? 7 : 8;
    byte_ = 0;
    used_ = 0;
  }
  std::string& out_;
  bool is_ls_;
  std::uint64_t byte_ = 0;
  int used_ = 0, room_ = 8;
};

// One restart interval of JPEG: rows from `first` to before `last`.
inline void put_lossless_rows(const JpegImage& image, const JpegForm& form, int first, int last,
                              JpegBitWriter& bits) {
  const auto sample = [&](int x, int y) { return image.at(x, y) >> form.point_transform; };
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < image.columns; ++x) {
      int predicted = 1 << (image.bits - form.point_transform - 1);
      if (x > 0 && y > first) {
        const int a = sample(x - 1, y), b = sample(x, y - 1), c = sample(x - 1, y - 1);
        const int table[] = {a,          b, c, a + b - c, a + ((b - c) >> 1), b + ((a - c) >> 1),
                             (a + b) / 2};
        predicted = table[form.predictor - 1];
      } else if (x > 0) {
        predicted = sample(x - 1, y);
      } else if (y > first) {
        predicted = sample(x, y - 1);
      }
      int difference = (sample(x, y) - predicted) & 0xffff;
      if (difference > 32768) difference -= 65536;
      int size = 0;
      while (std::abs(difference) >> size > 0) ++size;
      // Codes of five bits; or of 1 to 15 bits and two of 16, the commonest sizes not the shortest.
      const int rank = 16 - size;
      if (!form.has_long_codes) {
        bits.put(static_cast<std::uint64_t>(size), 5);
      } else {
        const std::uint64_t code = rank < 15 ? (2u << rank) - 2 : 0xffffu - (rank == 15);
        bits.put(code, std::min(rank + 1, 16));
      }
      if (size == 16) continue;
      bits.put(
          static_cast<std::uint64_t>(difference > 0 ? difference : difference + (1 << size) - 1),
          size);
    }
  }
}

// One restart interval of JPEG-LS. The picture's samples become the decoder's.
class JpegLsWriter {
 public:
  JpegLsWriter(JpegImage& image, const JpegForm& form) : image_(image), near_(form.near) {
    max_ = form.preset[0] ? form.preset[0] : (1 << image.bits) - 1;
    const auto clamp = [&](int i, int least) { return i > max_ || i < least ? least : i; };
    if (max_ >= 128) {
      const int f = (std::min(max_, 4095) + 128) / 256;
      t1_ = clamp(f + 2 + 3 * near_, near_ + 1);
      t2_ = clamp(4 * f + 3 + 5 * near_, t1_);
      t3_ = clamp(17 * f + 4 + 7 * near_, t2_);
    } else {
      const int f = 256 / (max_ + 1);
      t1_ = clamp(std::max(2, 3 / f + 3 * near_), near_ + 1);
      t2_ = clamp(std::max(3, 7 / f + 5 * near_), t1_);
      t3_ = clamp(std::max(4, 21 / f + 7 * near_), t2_);
    }
    if (form.preset[1]) t1_ = form.preset[1];
    if (form.preset[2]) t2_ = form.preset[2];
    if (form.preset[3]) t3_ = form.preset[3];
    if (form.preset[4]) reset_ = form.preset[4];
    range_ = (max_ + 2 * near_) / (2 * near_ + 1) + 1;
    while (1 << qbpp_ < range_) ++qbpp_;
    int bpp = 2;
    while (1 << bpp < max_ + 1) ++bpp;
    limit_ = 2 * (bpp + std::max(8, bpp));
  }

  void put_rows(int first, int last, JpegBitWriter& bits) {
    a_.fill(std::max(2, (range_ + 32) / 64));
    n_.fill(1);
    b_.fill(0);
    c_.fill(0);
    run_index_ = 0;
    const auto at = [&](int x, int y) { return y < first ? 0 : image_.at(x, y); };
    const auto left_of = [&](int x, int y) { return x > 0 ? at(x - 1, y) : at(0, y - 1); };
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < image_.columns;) {
        const int a = left_of(x, y), b = at(x, y - 1);
        const int c = y == first ? 0 : left_of(x, y - 1);
        const int d = x + 1 < image_.columns ? at(x + 1, y - 1) : b;
        const int q1 = region(d - b), q2 = region(b - c), q3 = region(c - a);
        if (q1 || q2 || q3) {
          put_regular(81 * q1 + 9 * q2 + q3, a, b, c, x++, y, bits);
          continue;
        }
        int run = 0;
        while (x < image_.columns && std::abs(image_.at(x, y) - a) <= near_) {
          set(x++, y, a);
          ++run;
        }
        for (; run >= 1 << kOrders[run_index_]; run_index_ += run_index_ < 31) {
          bits.put(1, 1);
          run -= 1 << kOrders[run_index_];
        }
        if (x == image_.columns) {
          if (run > 0) bits.put(1, 1);
          continue;
        }
        bits.put(static_cast<std::uint64_t>(run), 1 + kOrders[run_index_]);
        put_end_of_run(a, at(x, y - 1), x, y, bits);
        ++x;
      }
    }
  }

 private:
  static constexpr int kOrders[32] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,  2,  3,  3,  3,  3,
                                      4, 4, 5, 5, 6, 6, 7, 7, 8, 9, 10, 11, 12, 13, 14, 15};

  void set(int x, int y, int sample) {
    image_.samples[static_cast<std::size_t>(x + y * image_.columns)] = sample;
  }
  int region(int d) const {
    if (d <= -t3_) return -4;
    if (d <= -t2_) return -3;
    if (d <= -t1_) return -2;
    if (d < -near_) return -1;
    if (d <= near_) return 0;
    if (d < t1_) return 1;
    if (d < t2_) return 2;
    if (d < t3_) return 3;
    return 4;
  }

  // Quantizes an error, sets the sample as it will be decoded, and returns the error's residue.
  int quantized(int error, int predicted, int sign, int x, int y) {
    error = error > 0 ? (error + near_) / (2 * near_ + 1) : -((near_ - error) / (2 * near_ + 1));
    set(x, y, std::clamp(predicted + sign * error * (2 * near_ + 1), 0, max_));
    if (error < 0) error += range_;
    return error >= (range_ + 1) / 2 ? error - range_ : error;
  }
  void put_golomb(int value, int k, int limit, JpegBitWriter& bits) {
    const int high = value >> k;
    if (high < limit - qbpp_ - 1) {
      bits.put(1, high + 1);
      bits.put(static_cast<std::uint64_t>(value), k);
    } else {
      bits.put(1, limit - qbpp_);
      bits.put(static_cast<std::uint64_t>(value - 1), qbpp_);
    }
  }
  static int order(int a, int n) {
    int k = 0;
    while (n << k < a) ++k;
    return k;
  }

  void put_regular(int context, int a, int b, int c, int x, int y, JpegBitWriter& bits) {
    const int sign = context < 0 ? -1 : 1;
    const std::size_t q = static_cast<std::size_t>(std::abs(context));
    const int edge = c >= std::max(a, b)   ? std::min(a, b)
                     : c <= std::min(a, b) ? std::max(a, b)
                                           : a + b - c;
    const int predicted = std::clamp(edge + sign * c_[q], 0, max_);
    const int error = quantized(sign * (image_.at(x, y) - predicted), predicted, sign, x, y);
    const int k = order(a_[q], n_[q]);
    if (near_ == 0 && k == 0 && 2 * b_[q] <= -n_[q]) {
      put_golomb(error >= 0 ? 2 * error + 1 : -2 * (error + 1), k, limit_, bits);
    } else {
      put_golomb(error >= 0 ? 2 * error : -2 * error - 1, k, limit_, bits);
    }
    b_[q] += error * (2 * near_ + 1);
    a_[q] += std::abs(error);
    if (n_[q] == reset_) {
      a_[q] /= 2;
      b_[q] = b_[q] >= 0 ? b_[q] / 2 : -((1 - b_[q]) / 2);
      n_[q] /= 2;
    }
    ++n_[q];
    if (b_[q] <= -n_[q]) {
      b_[q] += n_[q];
      if (c_[q] > -128) --c_[q];
      if (b_[q] <= -n_[q]) b_[q] = -n_[q] + 1;
    } else if (b_[q] > 0) {
      b_[q] -= n_[q];
      if (c_[q] < 127) ++c_[q];
      if (b_[q] > 0) b_[q] = 0;
    }
  }

  void put_end_of_run(int a, int b, int x, int y, JpegBitWriter& bits) {
    const int type = std::abs(a - b) <= near_ ? 1 : 0, sign = type == 0 && a > b ? -1 : 1;
    const std::size_t q = static_cast<std::size_t>(365 + type);
    const int predicted = type == 1 ? a : b;
    const int error = quantized(sign * (image_.at(x, y) - predicted), predicted, sign, x, y);
    const int k = order(a_[q] + (type == 1 ? n_[q] / 2 : 0), n_[q]);
    const bool many = 2 * b_[q] >= n_[q];  // of negative errors
    const int map = (k == 0 && error > 0 && !many) || (error < 0 && (many || k != 0)) ? 1 : 0;
    const int value = 2 * std::abs(error) - type - map;
    put_golomb(value, k, limit_ - kOrders[run_index_] - 1, bits);
    if (error < 0) ++b_[q];
    a_[q] += (value + 1 - type) >> 1;
    if (n_[q] == reset_) {
      a_[q] /= 2;
      b_[q] /= 2;
      n_[q] /= 2;
    }
    ++n_[q];
    if (run_index_ > 0) --run_index_;
  }

  JpegImage& image_;
  int near_, max_ = 0, t1_ = 0, t2_ = 0, t3_ = 0, reset_ = 64, range_ = 0, qbpp_ = 0, limit_ = 0;
  std::array<int, 367> a_{}, b_{}, c_{}, n_{};
  std::size_t run_index_ = 0;
};

// Returns the picture's stream. `image` becomes what a decoder must return.
inline std::string jpeg_stream(JpegImage& image, const JpegForm& form) {
  const auto word = [](int n) { return big(static_cast<std::uint64_t>(n), 2); };
  const auto byte = [](int n) { return std::string(1, static_cast<char>(n)); };
  const auto segment = [&](int marker, const std::string& content) {
    return "\xff" + byte(marker) + word(static_cast<int>(content.size()) + 2) + content;
  };
  std::string out =
      "\xff\xd8" + segment(0xfe, "a comment") + "\xff" +
      segment(form.is_ls ? 0xf7 : 0xc3,
              byte(image.bits) + word(image.rows) + word(image.columns) + "\x01\x01\x11" + byte(0));
  if (!form.is_ls) {
    std::string lengths(16, '\0'), values;
    for (int n = 0; n < 16; ++n)
      lengths[static_cast<std::size_t>(n)] = static_cast<char>(form.has_long_codes ? 1 + n / 15
                                                               : n == 4            ? 17
                                                                                   : 0);
    for (int n = 0; n <= 16; ++n) values += static_cast<char>(form.has_long_codes ? 16 - n : n);
    out += segment(0xc4, byte(2) + lengths + values);
  } else if (form.preset != std::array<int, 5>{}) {
    std::string words;
    for (const int n : form.preset) words += word(n);
    out += segment(0xf8, byte(1) + words);
  }
  if (form.restart_rows > 0)
    out += segment(0xdd, word(form.restart_rows * (form.is_ls ? 1 : image.columns)));
  out += segment(0xda, byte(1) + byte(1) + byte(form.is_ls ? 0 : 0x20) +
                           byte(form.is_ls ? form.near : form.predictor) + byte(0) +
                           byte(form.point_transform));
  JpegLsWriter writer(image, form);
  const int interval = form.restart_rows > 0 ? form.restart_rows : image.rows;
  for (int first = 0; first < image.rows; first += interval) {
    if (first > 0) out += "\xff" + byte(0xd0 + (first / interval - 1) % 8);
    JpegBitWriter bits(out, form.is_ls);
    const int last = std::min(first + interval, image.rows);
    if (form.is_ls) writer.put_rows(first, last, bits);
    if (!form.is_ls) put_lossless_rows(image, form, first, last, bits);
    bits.end();
  }
  for (int& sample : image.samples) sample = sample >> form.point_transform << form.point_transform;
  return out + "\xff\xd9";
}

}  // namespace deliso::test
