// SPDX-License-Identifier: MIT
#include "io/files/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr std::uint8_t kPadding = 64, kSpace = 65, kOther = 66;

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::uint8_t, 256> make_values() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kOther);
  for (std::size_t n = 0; n < kDigits.size(); ++n)
    values[static_cast<unsigned char>(kDigits[n])] = static_cast<std::uint8_t>(n);
  for (char c : {' ', '\t', '\n', '\r', '\v', '\f'}) values[static_cast<unsigned char>(c)] = kSpace;
  values['='] = kPadding;
  return values;
}
constexpr std::array<std::uint8_t, 256> kValues = make_values();

}  // namespace

std::vector<std::byte> decode_base64(std::string_view text, std::size_t at_most) {
  std::vector<std::byte> bytes;
  bytes.reserve(std::min(at_most, text.size() / 4 * 3 + 3));
  std::uint32_t group = 0;
  unsigned digits = 0, padding = 0;
  for (char c : text) {
    const std::uint8_t value = kValues[static_cast<unsigned char>(c)];
    if (value == kSpace) continue;
    if (value == kOther || (padding > 0 && value != kPadding)) break;
    if (value == kPadding && ++padding > 2) break;
    group = group << 6 | (value & 63u);
    if (++digits < 4) continue;
    for (unsigned n = 0; n < 3 - padding; ++n) {
      if (bytes.size() == at_most) return bytes;
      bytes.push_back(static_cast<std::byte>(group >> (16 - 8 * n) & 0xff));
    }
    group = digits = padding = 0;
  }
  return bytes;
}

std::string encode_base64(std::span<const std::byte> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  for (std::size_t at = 0, to = 0; at < bytes.size(); at += 3, to += 4) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < count; ++n) {
      group |= std::to_integer<std::uint32_t>(bytes[at + n]) << (16 - 8 * n);
    }
    for (std::size_t n = 0; n <= count; ++n) text[to + n] = kDigits[group >> (18 - 6 * n) & 63u];
  }
  return text;
}

}  // namespace deliso
