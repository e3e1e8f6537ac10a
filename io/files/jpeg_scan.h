// SPDX-License-Identifier: MIT
// What the two decoders behind jpeg.h share: the bits of a scan, and its parameters.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace deliso {

// The bits of a scan up to the next marker, most significant first. Then it gives zeros and counts
// them, so that decoding can look ahead and test for the end once per line.
//
// Data has no markers, thanks to what follows a byte 0xff: in JPEG a byte of zeros, and in JPEG-LS
// a bit of zero, that do not count.
class JpegBits {
 public:
  JpegBits(std::span<const std::byte> in, bool is_ls) : in_(in), is_ls_(is_ls) {}

  // Makes at least 57 bits available.
  void refill() {
    while (count_ <= 56) {
      const unsigned byte = at(next_), after = at(next_ + 1);
      if (byte == kNone || (byte == 0xff && after >= (is_ls_ ? 0x80u : 1u))) {
        count_ += 8, missing_ += 8;
        continue;
      }
      const unsigned width = is_ls_ && next_ > 0 && at(next_ - 1) == 0xff ? 7 : 8;
      count_ += width;
      bits_ |= std::uint64_t{byte} << (64 - count_);
      next_ += byte == 0xff && !is_ls_ ? 2 : 1;
    }
  }
  std::uint32_t peek(unsigned n) const {
    return static_cast<std::uint32_t>(bits_ >> 1 >> (63 - n));  // n may be 0
  }
  void skip(unsigned n) {
    bits_ <<= n;
    count_ -= n;
  }
  // pre: n bits of the last refill are left; also for the others.
  std::uint32_t take(unsigned n) {
    const std::uint32_t value = peek(n);
    skip(n);
    return value;
  }
  // Returns the number of zeros up to the next one.
  unsigned zeros() const { return static_cast<unsigned>(std::countl_zero(bits_)); }
  // True if bits after the end were used.
  bool overrun() const { return missing_ > count_; }

  // Moves behind the restart marker of that number. Returns false if another one, or none, follows.
  bool restart(unsigned number) {
    while (at(next_) == 0xff && at(next_ + 1) == 0xff) ++next_;
    if (at(next_) != 0xff || at(next_ + 1) != 0xd0 + number % 8) return false;
    in_ = in_.subspan(next_ + 2);
    next_ = bits_ = count_ = missing_ = 0;
    return true;
  }

 private:
  static constexpr unsigned kNone = 0x100;  // the byte after the last
  unsigned at(std::size_t n) const {
    return n < in_.size() ? std::to_integer<unsigned>(in_[n]) : kNone;
  }

  std::span<const std::byte> in_;
  bool is_ls_;
  std::size_t next_ = 0;
  std::uint64_t bits_ = 0;  // the highest count_ of them
  unsigned count_ = 0;
  unsigned missing_ = 0;  // bits after the end, given as zeros
};

struct JpegScan {
  std::size_t columns, rows;
  std::span<std::uint16_t> out;
  int sample_bits = 0;
  int selection = 0;                   // JPEG: the predictor; JPEG-LS: NEAR, the largest error
  int point_transform = 0;             // the low bits that are left out
  std::size_t restart_rows = 0;        // from one restart marker to the next, or 0
  std::span<const std::byte> codes{};  // JPEG: how many of 1 to 16 bits, and what they mean
  std::array<int, 5> preset{};         // JPEG-LS: MAXVAL, T1, T2, T3, RESET; 0 for the usual ones
  JpegBits bits{{}, false};

  bool starts_at(std::size_t y) const {
    return y == 0 || (restart_rows > 0 && y % restart_rows == 0);
  }
  // Returns false if a restart marker is due before row y and is not there.
  bool restart_before(std::size_t y) {
    return !starts_at(y) || y == 0 || bits.restart(static_cast<unsigned>(y / restart_rows - 1));
  }
};

// Fill scan.out. Return a fault or null.
const char* decode_lossless_jpeg(JpegScan& scan);
const char* decode_jpeg_ls(JpegScan& scan);

}  // namespace deliso
