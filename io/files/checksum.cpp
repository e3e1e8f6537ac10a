// SPDX-License-Identifier: MIT
#include "io/files/checksum.h"

#include <algorithm>
#include <array>

#include "io/files/field_reader.h"

namespace deliso {
namespace {

// Eight tables let the CRC advance eight bytes at a time ("slicing by 8", Kounavis and Berry 2005).
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;
constexpr CrcTables make_crc_tables() {
  CrcTables tables{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ (c & 1 ? 0xedb88320u : 0u);
    tables[0][n] = c;
  }
  for (std::size_t t = 1; t < 8; ++t)
    for (std::size_t n = 0; n < 256; ++n)
      tables[t][n] = (tables[t - 1][n] >> 8) ^ tables[0][tables[t - 1][n] & 0xff];
  return tables;
}
constexpr CrcTables kCrc = make_crc_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint32_t c = ~before;
  while (bytes.size() >= 8) {
    const FieldReader words(bytes, std::endian::little);
    const std::uint32_t lo = c ^ words.get<std::uint32_t>(0), hi = words.get<std::uint32_t>(4);
    c = kCrc[7][lo & 0xff] ^ kCrc[6][lo >> 8 & 0xff] ^ kCrc[5][lo >> 16 & 0xff] ^
        kCrc[4][lo >> 24] ^ kCrc[3][hi & 0xff] ^ kCrc[2][hi >> 8 & 0xff] ^
        kCrc[1][hi >> 16 & 0xff] ^ kCrc[0][hi >> 24];
    bytes = bytes.subspan(8);
  }
  for (std::byte b : bytes) c = (c >> 8) ^ kCrc[0][(c ^ std::to_integer<std::uint32_t>(b)) & 0xff];
  return ~c;
}

std::uint32_t adler32(std::span<const std::byte> bytes, std::uint32_t before) {
  constexpr std::uint32_t modulus = 65521;
  constexpr std::size_t safe = 5552;  // bytes that cannot overflow the sums
  std::uint32_t a = before & 0xffff, b = before >> 16;
  while (!bytes.empty()) {
    const std::size_t n = std::min(safe, bytes.size());
    for (std::byte byte : bytes.first(n)) {
      a += std::to_integer<std::uint32_t>(byte);
      b += a;
    }
    a %= modulus;
    b %= modulus;
    bytes = bytes.subspan(n);
  }
  return b << 16 | a;
}

}  // namespace deliso
