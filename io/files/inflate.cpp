// SPDX-License-Identifier: MIT
#include "io/files/inflate.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "io/files/checksum.h"
#include "io/files/field_reader.h"
#include "io/files/prefix_code.h"

namespace deliso {
namespace {

// RFC 1951, 3.2.5: lengths 3..258 (symbols 257..285) and distances 1..32768.
constexpr std::uint16_t kLengthBase[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                         15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                         67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::uint8_t kLengthExtra[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                         2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};

Entry literal_or_length(std::size_t symbol) {
  if (symbol < 256) return {static_cast<std::uint16_t>(symbol), kLiteral, 0};
  if (symbol == 256) return {0, kEndOfBlock, 0};
  if (symbol > 285) return {0, kInvalid, 0};
  return {kLengthBase[symbol - 257], kLengthExtra[symbol - 257], 0};
}

Entry distance(std::size_t symbol) {
  if (symbol > 29) return {0, kInvalid, 0};
  if (symbol < 4) return {static_cast<std::uint16_t>(symbol + 1), 0, 0};
  const unsigned extra = static_cast<unsigned>(symbol / 2 - 1);
  return {static_cast<std::uint16_t>(((2 + symbol % 2) << extra) + 1),
          static_cast<std::uint8_t>(extra), 0};
}

Entry code_length(std::size_t symbol) {
  return {static_cast<std::uint16_t>(symbol), kLiteral, 0};
}

// One deflate stream into an output that may already hold earlier members.
class Decoder {
 public:
  Decoder(std::span<const std::byte> in, std::span<std::byte> out)
      : in_(in), bits_(in), out_(out) {}

  // Decodes blocks until the last one ends (true), the output is full or a fault is found (false).
  bool run() {
    for (bool last = false; !last;) {
      bits_.refill();
      last = bits_.take(1) == 1;
      switch (bits_.take(2)) {
        case 0:
          if (!stored_block()) return false;
          break;
        case 1:
          fixed_codes();
          if (!compressed_block()) return false;
          break;
        case 2:
          if (!dynamic_codes() || !compressed_block()) return false;
          break;
        default:
          return fail("an unknown block type");
      }
    }
    return !bits_.overrun() || fail("an early end");
  }

  std::size_t written() const { return written_; }
  const char* fault() const { return fault_; }
  std::size_t consumed() { return bits_.align(); }

 private:
  bool fail(const char* fault) {
    fault_ = bits_.overrun() ? "an early end" : fault;
    return false;
  }

  bool stored_block() {
    const std::size_t start = bits_.align();
    if (bits_.overrun() || in_.size() - start < 4) return fail("an early end");
    const FieldReader fields(in_, std::endian::little);
    const std::uint32_t length = fields.get<std::uint16_t>(start);
    if (length != (fields.get<std::uint16_t>(start + 2) ^ 0xffffu))
      return fail("a damaged stored block");
    const std::size_t available = in_.size() - start - 4;
    const std::size_t room = out_.size() - written_;
    const std::size_t n = std::min({std::size_t{length}, available, room});
    if (n > 0) std::memcpy(out_.data() + written_, in_.data() + start + 4, n);
    written_ += n;
    bits_.move_to(start + 4 + n);
    if (n == length) return true;
    return n == available && n < room ? fail("an early end") : false;
  }

  void fixed_codes() {
    std::array<std::uint8_t, 288> lengths;
    for (std::size_t n = 0; n < lengths.size(); ++n)
      lengths[n] = n < 144 ? 8 : n < 256 ? 9 : n < 280 ? 7 : 8;
    literals_.build(lengths, literal_or_length);
    std::array<std::uint8_t, 32> fives;
    fives.fill(5);
    distances_.build(fives, distance);
  }

  bool dynamic_codes() {
    bits_.refill();
    const std::size_t literal_count = bits_.take(5) + 257;
    const std::size_t distance_count = bits_.take(5) + 1;
    const std::size_t code_count = bits_.take(4) + 4;
    if (literal_count > 286) return fail("too many length codes");
    constexpr std::uint8_t order[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                      11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint8_t, 19> code_lengths{};
    for (std::size_t n = 0; n < code_count; ++n) {
      bits_.refill();
      code_lengths[order[n]] = static_cast<std::uint8_t>(bits_.take(3));
    }
    PrefixCode& codes = distances_;  // free until the distances are known
    if (!codes.build(code_lengths, code_length)) return fail("a damaged code table");

    std::array<std::uint8_t, 286 + 32> lengths{};
    const std::size_t total = literal_count + distance_count;
    for (std::size_t n = 0; n < total;) {
      bits_.refill();
      const Entry entry = codes.decode(bits_);
      if (entry.bits == 0) return fail("a damaged code table");
      if (entry.base < 16) {
        lengths[n++] = static_cast<std::uint8_t>(entry.base);
        continue;
      }
      if (entry.base == 16 && n == 0) return fail("a damaged code table");
      const std::uint8_t value = entry.base == 16 ? lengths[n - 1] : std::uint8_t{0};
      const std::size_t repeat = entry.base == 16   ? 3 + bits_.take(2)
                                 : entry.base == 17 ? 3 + bits_.take(3)
                                                    : 11 + bits_.take(7);
      if (repeat > total - n) return fail("a damaged code table");
      std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(n), repeat, value);
      n += repeat;
    }
    if (bits_.overrun()) return fail("an early end");
    if (lengths[256] == 0) return fail("a block without end");
    const std::span all(lengths);
    return (literals_.build(all.first(literal_count), literal_or_length) &&
            distances_.build(all.subspan(literal_count, distance_count), distance)) ||
           fail("a damaged code table");
  }

  bool compressed_block() {
    for (;;) {
      // 56 bits are enough for a length (15 + 5) and a distance (15 + 13).
      bits_.refill();
      const Entry symbol = literals_.decode(bits_);
      if (symbol.bits == 0 || symbol.extra == kInvalid) return fail("an unknown code");
      if (symbol.extra == kEndOfBlock) return true;
      // Every block consumes bits, so checking here for the end also bounds the loop.
      if (bits_.overrun()) return fail("an early end");
      const std::size_t room = out_.size() - written_;
      if (room == 0) return false;
      if (symbol.extra == kLiteral) {
        out_[written_++] = static_cast<std::byte>(symbol.base);
        continue;
      }
      const std::size_t length = symbol.base + bits_.take(symbol.extra);
      const Entry from = distances_.decode(bits_);
      if (from.bits == 0 || from.extra == kInvalid) return fail("an unknown code");
      const std::size_t back = from.base + bits_.take(from.extra);
      if (bits_.overrun()) return fail("an early end");
      if (back > written_) return fail("a match before the start");
      copy_match(back, std::min(length, room));
      if (length > room) return false;
    }
  }

  // Copies n bytes from `back` bytes before the end of the output; the two ranges may overlap, and
  // then the bytes repeat.
  void copy_match(std::size_t back, std::size_t n) {
    std::byte* to = out_.data() + written_;
    const std::byte* from = to - back;
    written_ += n;
    if (back >= 8 && out_.size() - written_ >= 8) {
      for (std::size_t done = 0; done < n; done += 8) std::memcpy(to + done, from + done, 8);
    } else if (back == 1) {
      std::memset(to, std::to_integer<int>(*from), n);
    } else {
      for (std::size_t done = 0; done < n; ++done) to[done] = from[done];
    }
  }

  std::span<const std::byte> in_;
  BitReader bits_;
  std::span<std::byte> out_;
  std::size_t written_ = 0;
  const char* fault_ = nullptr;
  PrefixCode literals_, distances_;
};

// Decodes a stream. If it ends, moves the beginning of `in` behind it.
Inflated decode(std::span<const std::byte>& in, std::span<std::byte> out) {
  Decoder decoder(in, out);
  const bool ended = decoder.run();
  if (ended) in = in.subspan(decoder.consumed());
  return {decoder.written(), ended, decoder.fault()};
}

// Length of the gzip member header at the start of `in`; 0 if there is none.
std::size_t gzip_header_size(std::span<const std::byte> in) {
  const auto byte = [&](std::size_t n) { return std::to_integer<unsigned>(in[n]); };
  if (in.size() < 10 || byte(0) != 0x1f || byte(1) != 0x8b || byte(2) != 8) return 0;
  const unsigned flags = byte(3);
  std::size_t at = 10;
  if (flags & 4) {  // extra field
    if (in.size() - at < 2) return 0;
    const std::size_t length = byte(at) + 256 * byte(at + 1);
    if (in.size() - at - 2 < length) return 0;
    at += 2 + length;
  }
  for (unsigned flag : {8u, 16u}) {  // file name, comment: up to a zero byte
    if (!(flags & flag)) continue;
    while (at < in.size() && byte(at) != 0) ++at;
    if (at == in.size()) return 0;
    ++at;
  }
  if (flags & 2) at += 2;  // header checksum
  return at <= in.size() ? at : 0;
}

Inflated inflate_gzip(std::span<const std::byte> in, std::span<std::byte> out) {
  Inflated result;
  for (bool first = true;; first = false) {
    const std::size_t header = gzip_header_size(in);
    if (header == 0) {
      if (first) result.fault = "no gzip header";
      result.ended = !first;
      return result;
    }
    in = in.subspan(header);
    const std::span<std::byte> rest = out.subspan(result.size);
    const Inflated member = decode(in, rest);
    result.size += member.size;
    result.fault = member.fault;
    if (!member.ended) return result;
    const FieldReader trailer(in, std::endian::little);
    if (in.size() < 8) {
      result.fault = "an early end";
    } else if (trailer.get<std::uint32_t>(0) != crc32(rest.first(member.size)) ||
               trailer.get<std::uint32_t>(4) != static_cast<std::uint32_t>(member.size)) {
      result.fault = "a wrong checksum";
    }
    if (result.fault) return result;
    in = in.subspan(8);
  }
}

Inflated inflate_zlib(std::span<const std::byte> in, std::span<std::byte> out) {
  const unsigned method = in.size() < 2 ? 0 : std::to_integer<unsigned>(in[0]);
  const unsigned flags = in.size() < 2 ? 0 : std::to_integer<unsigned>(in[1]);
  if (method % 16 != 8 || (256 * method + flags) % 31 != 0 || (flags & 32)) {
    return {.fault = "no zlib header"};
  }
  in = in.subspan(2);
  Inflated result = decode(in, out);
  if (!std::exchange(result.ended, false)) return result;
  if (in.size() < 4) {
    result.fault = "an early end";
  } else if (FieldReader(in, std::endian::big).get<std::uint32_t>(0) !=
             adler32(out.first(result.size))) {
    result.fault = "a wrong checksum";
  } else {
    result.ended = true;
  }
  return result;
}

}  // namespace

Inflated inflate(std::span<const std::byte> in, Wrapping wrapping, std::span<std::byte> out) {
  if (wrapping == Wrapping::gzip) return inflate_gzip(in, out);
  if (wrapping == Wrapping::zlib) return inflate_zlib(in, out);
  return decode(in, out);
}

}  // namespace deliso
