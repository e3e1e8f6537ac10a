// SPDX-License-Identifier: MIT
#include "view/render/write_png.h"

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "io/files/atomic_file.h"
#include "io/files/checksum.h"
#include "io/files/deflate.h"

namespace deliso {
namespace {

constexpr std::size_t kPixel = 3;  // bytes
constexpr int kFilters = 5;

void put_big(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
}

std::string chunk(std::string_view type, std::string_view content) {
  std::string out;
  put_big(out, static_cast<std::uint32_t>(content.size()));
  out.append(type).append(content);
  put_big(out, crc32(std::as_bytes(std::span(out).subspan(4))));
  return out;
}

// Whichever of left, above and corner is nearest to left + above - corner.
int paeth(int left, int above, int corner) {
  const int from_left = std::abs(above - corner), from_above = std::abs(left - corner);
  const int from_corner = std::abs(left + above - 2 * corner);
  if (from_left <= from_above && from_left <= from_corner) return left;
  return from_above <= from_corner ? above : corner;
}

// What the filter foresees for a byte.
int predicted(int filter, int left, int above, int corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4:
      return paeth(left, above, corner);
    default:
      return 0;
  }
}

std::string row_bytes(const Image& image, int y) {
  std::string bytes;
  for (int x = 0; x < image.width; ++x) {
    const Rgb& p = image.at(x, y);
    for (const std::uint8_t c : {p.red, p.green, p.blue}) bytes += static_cast<char>(c);
  }
  return bytes;
}

// The filter's number, then the row less what the filter foresees.
std::string filtered(int filter, std::string_view row, std::string_view row_above) {
  const auto byte = [](std::string_view bytes, std::size_t at) {
    return int{static_cast<unsigned char>(bytes[at])};
  };
  std::string out(1, static_cast<char>(filter));
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int left = i < kPixel ? 0 : byte(row, i - kPixel);
    const int corner = i < kPixel ? 0 : byte(row_above, i - kPixel);
    out += static_cast<char>(byte(row, i) - predicted(filter, left, byte(row_above, i), corner));
  }
  return out;
}

// How far the bytes are from zero, as signed numbers.
long weight(std::string_view bytes) {
  long sum = 0;
  for (const char c : bytes) sum += std::abs(static_cast<signed char>(c));
  return sum;
}

// Hands the file over piece by piece, as it gets ready.
template <class Put>
void encode(const Image& image, Put put) {
  DELISO_CHECK(image.width >= 1 && image.height >= 1);
  std::string header;
  put_big(header, static_cast<std::uint32_t>(image.width));
  put_big(header, static_cast<std::uint32_t>(image.height));
  header += {8, 2, 0, 0, 0};  // bits, RGB, deflate, the standard filters, not interlaced
  put("\x89PNG\r\n\x1a\n");
  put(chunk("IHDR", header));

  const auto put_data = [&](const std::string& data) {
    if (!data.empty()) put(chunk("IDAT", data));
  };
  DeflateStream stream;
  std::string above(kPixel * static_cast<std::size_t>(image.width), '\0');
  for (int y = 0; y < image.height; ++y) {
    std::string row = row_bytes(image, y);
    std::string best = filtered(0, row, above);
    long least = weight(best);
    for (int filter = 1; filter < kFilters; ++filter) {
      std::string other = filtered(filter, row, above);
      const long left = weight(other);
      if (left < least) {
        least = left;
        best = std::move(other);
      }
    }
    put_data(stream.add(best));
    above = std::move(row);
  }
  put_data(stream.finish());
  put(chunk("IEND", {}));
}

}  // namespace

std::string encode_png(const Image& image) {
  std::string png;
  encode(image, [&](const std::string& part) { png += part; });
  return png;
}

void write_png(const Image& image, const std::string& path) {
  AtomicFile file(path);
  encode(image, [&](const std::string& part) { file.write(part); });
  file.commit();
}

}  // namespace deliso
