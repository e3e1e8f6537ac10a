// SPDX-License-Identifier: MIT
// The bytes of an array as VTK's XML files hold them, in every form.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "io/files/deflate_writer.h"

namespace deliso::test {

inline std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t group = 0;
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - n);
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (b < have ? static_cast<unsigned char>(bytes[n + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      text += d <= have ? digits[group >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}
inline std::string ordered(std::uint64_t value, int bytes, std::endian order) {
  return order == std::endian::little ? little(value, bytes) : big(value, bytes);
}

struct VtkForm {
  std::string format = "appended";  // "ascii", "binary"
  std::string encoding = "raw";     // of the appended data: "base64"
  std::endian order = std::endian::little;
  int header_size = 4;
  std::size_t block = 0;  // 0: not compressed
};

// `bytes` in the form's byte order.
inline std::string vtk_array(const std::string& bytes, const VtkForm& form, std::uint64_t seed) {
  const auto number = [&](std::uint64_t n) { return ordered(n, form.header_size, form.order); };
  const auto coded = [&](const std::string& data) {
    return form.format == "appended" && form.encoding == "raw" ? data : base64(data);
  };
  if (form.block == 0) return coded(number(bytes.size()) + bytes);
  std::string sizes, data;
  std::uint64_t blocks = 0;
  for (std::size_t at = 0; at < bytes.size(); at += form.block, ++blocks) {
    const std::string piece = zlibbed(bytes.substr(at, form.block), seed + blocks);
    sizes += number(piece.size());
    data += piece;
  }
  return coded(number(blocks) + number(form.block) + number(bytes.size() % form.block) + sizes) +
         coded(data);
}

}  // namespace deliso::test
