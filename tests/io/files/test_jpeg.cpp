// SPDX-License-Identifier: MIT
#include "io/files/jpeg.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "io/damage.h"
#include "io/files/jpeg_writer.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct DecodedJpeg {
  JpegPicture picture;
  std::vector<int> samples;
  std::string fault() const { return picture.fault ? picture.fault : ""; }
};
// Decodes into a buffer of exactly the picture's size.
DecodedJpeg decoded_jpeg(const std::string& stream, int columns, int rows) {
  const std::vector<char> in(stream.begin(), stream.end());
  std::vector<std::uint16_t> out(static_cast<std::size_t>(columns * rows));
  const JpegPicture picture =
      decode_jpeg(std::as_bytes(std::span(in)), static_cast<std::size_t>(columns),
                  static_cast<std::size_t>(rows), out);
  return {picture, {out.begin(), out.end()}};
}

// Noise over all values, over few, flat regions with steps and specks, or a smooth slope.
JpegImage random_picture(Random& random, int bits, int largest) {
  JpegImage image{1 + static_cast<int>(random.below(60)), 1 + static_cast<int>(random.below(24)),
                  bits};
  const std::uint32_t kind = random.below(4);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.columns; ++x) {
      const int noise = static_cast<int>(random.below(static_cast<std::uint32_t>(largest) + 1));
      const int flat = random.below(30) == 0 ? noise : largest * (x / 17 + y / 9) / 8;
      const int slope = (x * x + 3 * y) * largest / 5000 + noise / 20;
      image.samples.push_back(kind == 0   ? noise
                              : kind == 1 ? noise % 3
                              : kind == 2 ? std::min(flat, largest)
                                          : std::min(slope, largest));
    }
  }
  return image;
}

JpegForm random_jpeg_form(Random& random, JpegImage& image) {
  const int bits = 2 + static_cast<int>(random.below(15));
  int largest = (1 << bits) - 1;
  JpegForm form;
  form.is_ls = random.below(2) == 0;
  if (form.is_ls) {
    if (random.below(2) == 0) {
      form.near = static_cast<int>(
          random.below(static_cast<std::uint32_t>(std::min(255, largest / 2) + 1)));
      if (random.below(2) == 0) form.near %= 4;
    }
    const int least = std::max(1, 2 * form.near);
    if (random.below(3) == 0) {
      largest = form.preset[0] =
          least + static_cast<int>(random.below(static_cast<std::uint32_t>(largest - least + 1)));
    }
    if (random.below(3) == 0) {
      int from = form.near + 1;
      for (std::size_t n = 1; n < 4; ++n) {
        from +=
            static_cast<int>(random.below(static_cast<std::uint32_t>((largest - from) / 3 + 1)));
        form.preset[n] = from;
      }
    }
    if (random.below(3) == 0) form.preset[4] = 3 + static_cast<int>(random.below(250));
  } else {
    form.predictor = 1 + static_cast<int>(random.below(7));
    form.has_long_codes = random.below(2) == 0;
    if (random.below(4) == 0)
      form.point_transform = static_cast<int>(random.below(static_cast<std::uint32_t>(bits)));
  }
  image = random_picture(random, bits, largest);
  if (random.below(3) == 0) form.restart_rows = 1 + static_cast<int>(random.below(5));
  return form;
}

}  // namespace

// T.87, H.3: a picture of 4 x 4 samples, and its code.
TEST_CASE("the example of the standard of JPEG-LS") {
  const std::string stream(
      "\xff\xd8\xff\xf7\x00\x0b\x08\x00\x04\x00\x04\x01\x01\x11\x00\xff\xda\x00\x08\x01\x01\x00\x00"
      "\x00\x00\xc0\x00\x00\x6c\x80\x20\x8e\x01\xc0\x00\x00\x57\x40\x00\x00\x6e\xe6\x00\x00\x01\xbc"
      "\x18\x00\x00\x05\xd8\x00\x00\x91\x60\xff\xd9",
      57);
  const std::vector<int> samples{0,  0,   90,  74,  68,  50,  43,  205,
                                 64, 145, 145, 145, 100, 145, 145, 145};
  const DecodedJpeg found = decoded_jpeg(stream, 4, 4);
  CHECK(found.fault() == "");
  CHECK(found.picture.bits == 8);
  CHECK(found.samples == samples);
}

// Predicted are 128, 130 (left), 130 (above) and 131 + 130 - 130, which is predictor 4. So the
// differences are 2, 0, 1 and -6, of 2, 0, 1 and 3 bits. Their codes are 110, 0, 10 and 1110, the
// bits behind them 10, none, 1 and 001: 11010 0 101 1110001, and ones.
TEST_CASE("a lossless JPEG that was worked out by hand") {
  const std::string stream(
      "\xff\xd8\xff\xc4\x00\x17\x00\x01\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
      "\x00\x01\x02\x03\xff\xc3\x00\x0b\x08\x00\x02\x00\x02\x01\x01\x11\x00\xff\xda\x00\x08\x01\x01"
      "\x00\x04\x00\x00\xd2\xf1\xff\xd9",
      54);
  const DecodedJpeg found = decoded_jpeg(stream, 2, 2);
  CHECK(found.fault() == "");
  CHECK(found.samples == std::vector<int>{130, 130, 131, 125});
}

TEST_CASE("random pictures come back from JPEG and JPEG-LS, in every form") {
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    JpegImage image;
    const JpegForm form = random_jpeg_form(random, image);
    JpegImage coded = image;
    const std::string stream = jpeg_stream(coded, form);
    const DecodedJpeg found = decoded_jpeg(stream, image.columns, image.rows);
    REQUIRE(found.fault() == "");
    REQUIRE(found.picture.bits == image.bits);
    REQUIRE(found.samples == coded.samples);
    int worst = 0;
    for (std::size_t n = 0; n < image.samples.size(); ++n) {
      worst = std::max(worst, std::abs(image.samples[n] - found.samples[n]));
    }
    CHECK(worst <= std::max(form.near, (1 << form.point_transform) - 1));
  }
}

TEST_CASE("a JPEG stream that is cut has a fault, one that is damaged a fault or another picture") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    JpegImage image;
    const JpegForm form = random_jpeg_form(random, image);
    const std::string stream = jpeg_stream(image, form);
    // The last marker, and a byte before it that may have no more than stuffing, are not missed.
    for (std::size_t size = 0; size + 4 < stream.size(); size += 1 + random.below(20)) {
      CHECK(decoded_jpeg(stream.substr(0, size), image.columns, image.rows).fault() != "");
    }
    for (int n = 0; n < 50; ++n) {
      const DecodedJpeg found = decoded_jpeg(damaged(stream, random), image.columns, image.rows);
      CHECK((found.picture.fault || (found.picture.bits >= 2 && found.picture.bits <= 16)));
    }
  }
}

TEST_CASE("each fault of a JPEG stream has its words") {
  Random random(7);
  JpegImage image = random_picture(random, 8, 255);
  JpegForm form;
  form.restart_rows = 1;
  std::string stream, ls;
  image.columns = 4, image.rows = 3;
  image.samples.resize(12);
  stream = jpeg_stream(image, form);
  form.is_ls = true;
  form.preset = {255, 3, 7, 21, 64};
  ls = jpeg_stream(image, form);
  // `at` is counted from the last such marker.
  const auto with = [&](const std::string& whole, const std::string& marker, std::size_t at,
                        int byte) {
    std::string edited = whole;
    edited[whole.rfind(marker) + at] = static_cast<char>(byte);
    return decoded_jpeg(edited, 4, 3).fault();
  };
  CHECK(with(stream, "\xff\xc3", 1, 0xc3) == "");
  CHECK(with(ls, "\xff\xf7", 1, 0xf7) == "");
  CHECK(with(stream, "\xff\xd8", 1, 0) == "no JPEG");
  CHECK(with(stream, "\xff\xda", 0, 0) == "no marker where one is due");
  CHECK(with(stream, "\xff\xc3", 1, 0xc0) == "another process than the lossless one");
  CHECK(with(stream, "\xff\xc3", 1, 0xe0) == "a scan before its frame");
  CHECK(with(stream, "\xff\xc3", 4, 17) == "samples of more than 16 bits");
  CHECK(with(stream, "\xff\xc3", 6, 4) == "another size");
  CHECK(with(stream, "\xff\xc3", 9, 3) == "a picture in color");
  CHECK(with(stream, "\xff\xda", 4, 3) == "a picture in color");
  CHECK(with(stream, "\xff\xda", 6, 0) == "an unknown code");
  CHECK(with(stream, "\xff\xda", 7, 0) == "an unknown predictor");
  CHECK(with(stream, "\xff\xda", 9, 8) == "no bits left");
  CHECK(with(stream, "\xff\xda", 2, 255) == "an early end");
  CHECK(with(stream, "\xff\xc4", 5, 255) == "an early end");
  CHECK(with(stream, "\xff\xdd", 5, 5) == "a restart within a row");
  CHECK(with(stream, "\xff\xd0", 1, 0xd1) == "no restart marker where one is due");
  CHECK(with(ls, "\xff\xd0", 1, 0xd1) == "no restart marker where one is due");
  CHECK(with(ls, "\xff\xf8", 4, 2) == "a palette, or a size of its own");
  CHECK(with(ls, "\xff\xf8", 5, 9) == "impossible parameters");
  CHECK(with(ls, "\xff\xf8", 14, 1) == "impossible parameters");
  CHECK(with(ls, "\xff\xda", 7, 128) == "impossible parameters");
  CHECK(with(ls, "\xff\xda", 9, 1) == "a point transform");
}
