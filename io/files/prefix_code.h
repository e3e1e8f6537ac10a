// SPDX-License-Identifier: MIT
// Bits from bytes, and prefix codes as look-up tables (RFC 1951, 3.1.1 and 3.2.2), for inflate.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/files/field_reader.h"

namespace deliso {

// Bits of a deflate stream, least significant first. After the end it gives zeros and counts them,
// so that decoding can look ahead and test for the end once per symbol.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> in) : in_(in) {}

  // Makes at least 56 bits available.
  void refill() {
    if (in_.size() - next_ >= 8) {
      bits_ |= FieldReader(in_, std::endian::little).get<std::uint64_t>(next_) << count_;
      const unsigned bytes = (63 - count_) >> 3;
      next_ += bytes;
      count_ += 8 * bytes;
      return;
    }
    while (count_ <= 56) {
      if (next_ < in_.size()) {
        bits_ |= std::to_integer<std::uint64_t>(in_[next_++]) << count_;
      } else {
        ++missing_;
      }
      count_ += 8;
    }
  }
  std::uint32_t peek(unsigned n) const {
    return static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << n) - 1));
  }
  void skip(unsigned n) {
    bits_ >>= n;
    count_ -= n;
  }
  // pre: n bits of the last refill are left.
  std::uint32_t take(unsigned n) {
    const std::uint32_t value = peek(n);
    skip(n);
    return value;
  }
  // True if bits after the end of the input were used.
  bool overrun() const { return 8 * missing_ > count_; }

  // Drops the bits up to the next byte boundary; returns the offset of the first unused byte.
  std::size_t align() {
    skip(count_ & 7);
    const std::size_t unread = count_ / 8;
    const std::size_t offset = unread > missing_ ? next_ - (unread - missing_) : next_;
    return offset;
  }
  void move_to(std::size_t offset) {
    next_ = offset;
    bits_ = 0;
    count_ = 0;
    missing_ = 0;
  }

 private:
  std::span<const std::byte> in_;
  std::size_t next_ = 0;  // first byte not yet in bits_
  std::uint64_t bits_ = 0;
  unsigned count_ = 0;       // valid bits in bits_
  std::size_t missing_ = 0;  // bytes after the end, given as zeros
};

// An entry of a prefix code's look-up tables. The next kRootBits bits select an entry; longer codes
// continue in a second table. `entry_of` maps symbols to entries.
struct Entry {
  std::uint16_t base = 0;  // literal, or first value of a length or distance, or second table
  std::uint8_t extra = 0;  // number of extra bits, or one of the kinds below
  std::uint8_t bits = 0;   // length of the code (within its table); 0: no such code
};
constexpr std::uint8_t kLiteral = 32, kEndOfBlock = 33, kInvalid = 34, kSecondTable = 64;

constexpr unsigned kRootBits = 10;
constexpr unsigned kLongestCode = 15;

class PrefixCode {
 public:
  // Builds the canonical code with these code lengths (0: symbol unused). Returns false if the
  // lengths are no prefix code. An incomplete code may have one symbol at most, as RFC 1951 needs
  // for distances.
  template <class EntryOf>
  bool build(std::span<const std::uint8_t> lengths, EntryOf entry_of) {
    std::array<std::uint16_t, kLongestCode + 1> count{};
    for (std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    int left = 1;
    unsigned used = 0;
    std::array<std::uint16_t, kLongestCode + 2> next_code{};
    for (unsigned length = 1; length <= kLongestCode; ++length) {
      left = 2 * left - count[length];
      if (left < 0) return false;
      used += count[length];
      next_code[length + 1] = static_cast<std::uint16_t>((next_code[length] + count[length]) << 1);
    }
    if (left > 0 && used > 1) return false;

    entries_.fill({});
    std::size_t end = std::size_t{1} << kRootBits;
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      const unsigned length = lengths[symbol];
      if (length == 0) continue;
      const std::uint32_t code = reversed(next_code[length]++, length);
      Entry entry = entry_of(symbol);
      if (length <= kRootBits) {
        entry.bits = static_cast<std::uint8_t>(length);
        for (std::size_t n = code; n < (std::size_t{1} << kRootBits); n += std::size_t{1} << length)
          entries_[n] = entry;
        continue;
      }
      Entry& root = entries_[code & ((1u << kRootBits) - 1)];
      if (root.bits == 0) {  // every second table has the size for the longest codes
        root = {static_cast<std::uint16_t>(end), kSecondTable, kRootBits};
        end += std::size_t{1} << kSecondBits;
      }
      entry.bits = static_cast<std::uint8_t>(length - kRootBits);
      for (std::size_t n = code >> kRootBits; n < (std::size_t{1} << kSecondBits);
           n += std::size_t{1} << entry.bits)
        entries_[root.base + n] = entry;
    }
    return true;
  }

  // pre: the reader holds kLongestCode bits. An entry with bits == 0 means: no such code.
  Entry decode(BitReader& in) const {
    Entry entry = entries_[in.peek(kRootBits)];
    if (entry.extra == kSecondTable) {
      in.skip(kRootBits);
      entry = entries_[entry.base + in.peek(kSecondBits)];
    }
    in.skip(entry.bits);
    return entry;
  }

 private:
  static constexpr unsigned kSecondBits = kLongestCode - kRootBits;

  static std::uint32_t reversed(std::uint32_t code, unsigned length) {
    std::uint32_t result = 0;
    for (unsigned n = 0; n < length; ++n) result |= (code >> n & 1u) << (length - 1 - n);
    return result;
  }

  // A second table needs at least two codes longer than kRootBits, so 288 symbols make at most 144.
  std::array<Entry, (1u << kRootBits) + 144 * (1u << kSecondBits)> entries_;
};

}  // namespace deliso
