// SPDX-License-Identifier: MIT
// Pictures come back pixel by pixel from their files, through a decoder made for this test after
// ISO/IEC 15948 and the project's own inflate.
#include "view/render/write_png.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdlib>
#include <set>
#include <string>

#include "base/check.h"
#include "base/random.h"
#include "io/files/deflate_writer.h"
#include "io/files/inflated.h"
#include "io/files/temporary_folder.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::uint32_t big32_at(const std::string& bytes, std::size_t at) {
  REQUIRE(at + 4 <= bytes.size());
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + n]);
  }
  return value;
}

struct Decoded {
  Image image;
  std::set<int> filters;
};

Decoded decode_png(const std::string& png) {
  REQUIRE(png.starts_with("\x89PNG\r\n\x1a\n"));
  std::string header, data, order;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = big32_at(png, at);
    REQUIRE(at + 12 + size <= png.size());
    const std::string type = png.substr(at + 4, 4), content = png.substr(at + 8, size);
    CHECK(big32_at(png, at + 8 + size) == slow_crc32(type + content));
    order += type;
    if (type == "IHDR") header = content;
    if (type == "IDAT") data += content;
    at += 12 + size;
  }
  CHECK(order.starts_with("IHDRIDAT"));
  CHECK(order.find_first_not_of("IDAT", 4) == order.size() - 3);  // data alone, up to the end
  CHECK(order.ends_with("IDATIEND"));
  REQUIRE(header.size() == 13);
  CHECK(header.substr(8) == std::string({8, 2, 0, 0, 0}));

  Decoded decoded;
  decoded.image =
      Image(static_cast<int>(big32_at(header, 0)), static_cast<int>(big32_at(header, 4)));
  const std::size_t columns = 3 * static_cast<std::size_t>(decoded.image.width);
  const auto height = static_cast<std::size_t>(decoded.image.height);
  const std::string rows = inflated(data, Wrapping::zlib, (1 + columns) * height);

  std::vector<int> above(columns + 3, 0), row(columns + 3, 0);  // three zeros on the left
  for (std::size_t y = 0; y < height; ++y) {
    const int filter = rows[y * (1 + columns)];
    decoded.filters.insert(filter);
    for (std::size_t i = 0; i < columns; ++i) {
      const int raw = static_cast<unsigned char>(rows[y * (1 + columns) + 1 + i]);
      const int a = row[i], b = above[i + 3], c = above[i];
      const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
      const int nearest = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      const int foreseen[] = {0, a, b, (a + b) / 2, nearest};
      REQUIRE(filter < 5);
      row[i + 3] = (raw + foreseen[filter]) % 256;
    }
    for (int x = 0; x < decoded.image.width; ++x) {
      const std::size_t i = 3 + 3 * static_cast<std::size_t>(x);
      decoded.image.at(x, static_cast<int>(y)) = {static_cast<std::uint8_t>(row[i]),
                                                  static_cast<std::uint8_t>(row[i + 1]),
                                                  static_cast<std::uint8_t>(row[i + 2])};
    }
    above = row;
  }
  return decoded;
}

// Planes of color, with noise of some strength on some rows.
Image random_image(Random& random) {
  Image image(1 + static_cast<int>(random.below(60)), 1 + static_cast<int>(random.below(60)));
  const std::uint32_t a = random.below(8), b = random.below(8), noise = 1 + random.below(40);
  for (int y = 0; y < image.height; ++y) {
    const bool noisy = random.below(3) == 0;
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t plane =
          a * static_cast<std::uint32_t>(x) + b * static_cast<std::uint32_t>(y);
      const auto part = [&] {
        return static_cast<std::uint8_t>(plane + (noisy ? random.below(noise * noise) : 0));
      };
      image.at(x, y) = {part(), part(), part()};
    }
  }
  return image;
}

}  // namespace

TEST_CASE("random pictures come back, with every filter in use") {
  std::set<int> filters;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Image image = random_image(random);
    const Decoded decoded = decode_png(encode_png(image));
    REQUIRE(decoded.image.width == image.width);
    REQUIRE(decoded.image.height == image.height);
    REQUIRE(decoded.image.pixels == image.pixels);
    filters.insert(decoded.filters.begin(), decoded.filters.end());
  }
  CHECK(filters == std::set<int>{0, 1, 2, 3, 4});
}

TEST_CASE("a picture of several pieces of data comes back") {
  Image image(2000, 1700);
  Random random(3);
  for (Rgb& p : image.pixels) p.red = static_cast<std::uint8_t>(random.below(2));
  CHECK(decode_png(encode_png(image)).image.pixels == image.pixels);
}

TEST_CASE("the file has the encoded bytes; a fault names it and leaves nothing") {
  const TemporaryFolder folder;
  Random random(5);
  const Image image = random_image(random);
  write_png(image, folder / "a.png");
  CHECK(file_bytes(folder / "a.png") == encode_png(image));
  CHECK_THROWS_AS(write_png(image, folder / "no/a.png"), InputError);
  CHECK(folder.file_count() == 1);
}
