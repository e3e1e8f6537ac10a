// SPDX-License-Identifier: MIT
#include "cases.h"
#include "io/files/inflate.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "base/random.h"
#include "io/damage.h"
#include "io/files/checksum.h"
#include "io/files/deflate_writer.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// Inflates into a buffer of exactly `room` bytes.
struct Result {
  Inflated inflated;
  std::string content;
};
Result run(const std::string& data, Wrapping wrapping, std::size_t room) {
  std::vector<std::byte> out(room);
  const Inflated inflated = inflate(bytes_of(data), wrapping, out);
  REQUIRE(inflated.size <= room);
  return {inflated, std::string(reinterpret_cast<const char*>(out.data()), inflated.size)};
}

bool is_whole(const Result& result, const std::string& content) {
  return result.inflated.fault == nullptr && result.inflated.ended && result.content == content;
}

std::string random_bytes(Random& random, std::size_t size) {
  std::string bytes(size, '\0');
  for (char& c : bytes) c = static_cast<char>(random.below(256));
  return bytes;
}

// gzip -9 of "voxel 0 of 0\nvoxel 1 of 1\nvoxel 2 of 4\n...": 60 lines of n and n * n % 7.
constexpr unsigned char kGzipFile[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x55, 0x92, 0x39, 0x0e, 0xc3, 0x30,
    0x10, 0x03, 0xfb, 0xbc, 0xc2, 0x4f, 0xd0, 0x5e, 0x3a, 0x1e, 0x94, 0x54, 0x01, 0xdc, 0x19, 0x7e,
    0x7e, 0xe0, 0x40, 0x05, 0xa7, 0x1c, 0x48, 0xe4, 0x12, 0xdc, 0xbd, 0xce, 0xfb, 0xfd, 0x3d, 0xda,
    0x71, 0x7e, 0x8e, 0xf6, 0xba, 0xfe, 0x60, 0x0f, 0xd8, 0x06, 0x7f, 0x20, 0x37, 0xc4, 0x03, 0xbe,
    0x21, 0x15, 0x4a, 0xbf, 0x75, 0x35, 0x18, 0x6a, 0x3d, 0xf5, 0x65, 0xa9, 0xc6, 0x9a, 0xda, 0x99,
    0x81, 0x10, 0xc2, 0x42, 0x4d, 0x2c, 0x11, 0xbd, 0xf0, 0xd6, 0xa1, 0x1b, 0xf0, 0x9c, 0x20, 0x64,
    0xf1, 0x86, 0x06, 0x4c, 0x27, 0xb8, 0xe3, 0x2d, 0xa0, 0x43, 0x25, 0x5e, 0x20, 0x64, 0xf1, 0x01,
    0x97, 0x89, 0x09, 0x4b, 0xdf, 0xa2, 0x61, 0x01, 0xe8, 0x25, 0x1c, 0x84, 0x2c, 0x91, 0x70, 0x29,
    0x9d, 0x10, 0x58, 0x50, 0x0c, 0xe8, 0xd0, 0x4b, 0x2c, 0x6c, 0x1c, 0x59, 0x12, 0x77, 0x92, 0xae,
    0x13, 0x12, 0x3b, 0xca, 0x84, 0x0e, 0xbd, 0x64, 0x07, 0x21, 0x4b, 0xe2, 0x5c, 0x72, 0xe9, 0x84,
    0xc2, 0x8e, 0xca, 0x54, 0x57, 0xe8, 0xa5, 0x70, 0xb5, 0x85, 0x2c, 0x85, 0x7b, 0xa9, 0x8e, 0x09,
    0xd8, 0x51, 0x4d, 0xe8, 0x76, 0x2f, 0x3f, 0x04, 0xef, 0xee, 0xe1, 0x3e, 0x03, 0x00, 0x00};
// zlib at level 9, of 300 values below 7 from a linear congruential generator.
constexpr unsigned char kZlibData[] = {
    0x78, 0xda, 0x1d, 0x8f, 0xc9, 0x11, 0xc0, 0x30, 0x0c, 0x02, 0x41, 0x1c, 0xfd, 0x97, 0x1c,
    0x9c, 0x19, 0x7f, 0x24, 0x03, 0x5a, 0xe4, 0xb0, 0x65, 0x91, 0x34, 0x35, 0x49, 0xdc, 0x6d,
    0xac, 0xd0, 0xb3, 0x79, 0x7a, 0x7f, 0xd7, 0xc6, 0x9b, 0x99, 0x04, 0xc2, 0x29, 0xdc, 0x4a,
    0x97, 0x49, 0xc9, 0xf9, 0x5c, 0x20, 0x8c, 0x4e, 0x88, 0xcf, 0x30, 0x3a, 0x13, 0xe0, 0xa9,
    0x42, 0x4e, 0x69, 0x02, 0x4b, 0x89, 0x14, 0xc1, 0xea, 0xbf, 0x5c, 0xc4, 0x72, 0x76, 0xd1,
    0x17, 0xca, 0x94, 0xf8, 0x74, 0xd4, 0x30, 0xb6, 0x28, 0xfc, 0xe0, 0x1e, 0xe2, 0xe2, 0xad,
    0x1d, 0x1d, 0x8b, 0x06, 0x3a, 0xaa, 0xba, 0xc6, 0xd3, 0x5e, 0x0f, 0x5a, 0x30, 0x54, 0xe7,
    0x85, 0x2c, 0x0e, 0xaf, 0x0f, 0x24, 0x19, 0xe2, 0x73, 0xc2, 0xf7, 0xf8, 0xbb, 0x3e, 0x87,
    0xe3, 0x4a, 0xec, 0xed, 0x64, 0x1f, 0x28, 0x3c, 0xf5, 0x8d, 0x7e, 0x84, 0x7d, 0xd4, 0xb3,
    0x38, 0xaf, 0xd0, 0x1c, 0xeb, 0x70, 0xe5, 0x4a, 0xf3, 0x03, 0x23, 0x97, 0x03, 0x8b};

}  // namespace

TEST_CASE("checksums equal published values and those computed bit by bit") {
  CHECK(crc32(bytes_of("123456789")) == 0xcbf43926u);
  CHECK(adler32(bytes_of("Wikipedia")) == 0x11e60398u);
  CHECK(crc32({}) == 0);
  CHECK(adler32({}) == 1);
  Random random(1);
  for (std::size_t size = 0; size < 200; ++size) {
    const std::string bytes = random_bytes(random, size);
    CHECK(crc32(bytes_of(bytes)) == slow_crc32(bytes));
    CHECK(adler32(bytes_of(bytes)) == slow_adler32(bytes));
  }
  const std::string high(100000, '\xff');
  CHECK(crc32(bytes_of(high)) == slow_crc32(high));
  CHECK(adler32(bytes_of(high)) == slow_adler32(high));
}

TEST_CASE("data made by gzip and zlib is decompressed") {
  std::string lines;
  for (int n = 0; n < 60; ++n)
    lines += "voxel " + std::to_string(n) + " of " + std::to_string(n * n % 7) + "\n";
  const std::string gzip(reinterpret_cast<const char*>(kGzipFile), sizeof kGzipFile);
  CHECK(is_whole(run(gzip, Wrapping::gzip, lines.size()), lines));
  CHECK(is_whole(run(gzip, Wrapping::gzip, lines.size() + 100), lines));

  std::string values;
  std::uint32_t x = 1;
  for (int n = 0; n < 300; ++n) {
    x = (x * 1103515245u + 12345u) % (1u << 31);
    values += static_cast<char>((x >> 16) % 7);
  }
  const std::string zlib(reinterpret_cast<const char*>(kZlibData), sizeof kZlibData);
  CHECK(is_whole(run(zlib, Wrapping::zlib, values.size()), values));
}

TEST_CASE("random blocks of every kind, with random codes, are decompressed") {
  for (std::uint64_t seed = 0; seed < test::cases(3000u); ++seed) {
    Random random(seed);
    DeflateWriter writer;
    std::string content;
    std::vector<Token> tokens;
    const int blocks = 1 + static_cast<int>(random.below(4));
    for (int n = 0; n < blocks; ++n) {
      const auto kind = static_cast<DeflateWriter::Block>(random.below(3));
      // Distances may reach back into earlier blocks only through these tokens, which start anew.
      tokens = random_tokens(random, static_cast<int>(random.below(n == 0 ? 300 : 60)));
      writer.block(kind, tokens, n + 1 == blocks, random);
      content += expand(tokens);
    }
    const std::string data = writer.finish();
    CAPTURE(seed);
    REQUIRE(is_whole(run(gzip_wrapped(data, content), Wrapping::gzip, content.size()), content));
    REQUIRE(
        is_whole(run(zlib_wrapped(data, content), Wrapping::zlib, content.size() + 9), content));
    REQUIRE(is_whole(run(data, Wrapping::none, content.size() + 9), content));

    // A smaller buffer gets the beginning, which is no fault.
    if (content.empty()) continue;
    const std::size_t room = random.below(static_cast<std::uint32_t>(content.size()));
    const Result part = run(gzip_wrapped(data, content), Wrapping::gzip, room);
    REQUIRE(part.inflated.fault == nullptr);
    REQUIRE(!part.inflated.ended);
    REQUIRE(part.content == content.substr(0, room));
  }
}

TEST_CASE("matches up to the greatest distance, across blocks, are decompressed") {
  Random random(7);
  std::vector<Token> tokens = literals(random_bytes(random, 32768));
  for (int n = 0; n < 2000; ++n)
    tokens.push_back({3 + static_cast<int>(random.below(256)),
                      n % 3 ? 32768 - static_cast<int>(random.below(2000)) : 32768});
  const std::string content = expand(tokens);
  const std::vector<Token> first(tokens.begin(), tokens.begin() + 33000);
  const std::vector<Token> second(tokens.begin() + 33000, tokens.end());
  DeflateWriter writer;
  writer.block(DeflateWriter::Block::fixed, first, false, random);
  writer.block(DeflateWriter::Block::dynamic, second, true, random);
  const std::string data = zlib_wrapped(writer.finish(), content);
  CHECK(is_whole(run(data, Wrapping::zlib, content.size()), content));
}

TEST_CASE("gzip headers with every optional field, several members, bytes behind the end") {
  const std::string a = "first member, ", b = "second";
  const std::string plain = gzipped(b);
  std::string fields("\x1f\x8b\x08\x1e\0\0\0\0\0\x03", 10);
  fields +=
      std::string("\x05\0extra", 7) + std::string("name\0", 5) + std::string("note\0", 5) + "cc";
  const std::string data = fields + gzipped(a).substr(10) + plain;
  CHECK(is_whole(run(data, Wrapping::gzip, a.size() + b.size()), a + b));
  CHECK(is_whole(run(data + std::string(5, '\0'), Wrapping::gzip, 99), a + b));
  CHECK(is_whole(run(gzipped(""), Wrapping::gzip, 0), ""));
  for (std::size_t size = 0; size < fields.size(); ++size)
    CHECK(run(data.substr(0, size), Wrapping::gzip, 99).inflated.fault != nullptr);
}

TEST_CASE("every fault has its message") {
  const std::string content = "0123456789";
  const auto fault = [](const std::string& data, Wrapping wrapping) {
    const Inflated result = run(data, wrapping, 100).inflated;
    return std::string(result.fault ? result.fault : "none");
  };
  const auto deflate_fault = [&](const std::string& bits) {
    return fault("\x78\x9c" + bits, Wrapping::zlib);
  };
  CHECK(fault("", Wrapping::gzip) == "no gzip header");
  CHECK(fault("PK\3\4 some other archive", Wrapping::gzip) == "no gzip header");
  CHECK(fault("", Wrapping::zlib) == "no zlib header");
  CHECK(fault("\x78\x9d", Wrapping::zlib) == "no zlib header");
  CHECK(fault("\x78\xbb dictionary", Wrapping::zlib) == "no zlib header");
  std::string data = gzipped(content);
  data[data.size() - 8] ^= 1;
  CHECK(fault(data, Wrapping::gzip) == "a wrong checksum");
  data = gzipped(content);
  data[data.size() - 1] ^= 1;
  CHECK(fault(data, Wrapping::gzip) == "a wrong checksum");
  data = zlibbed(content);
  data.back() ^= 1;
  CHECK(fault(data, Wrapping::zlib) == "a wrong checksum");
  CHECK(deflate_fault("\x07") == "an unknown block type");
  CHECK(deflate_fault(std::string("\x01\x01\0\xff\xff!", 6)) == "a damaged stored block");
  CHECK(deflate_fault("") == "an early end");
  // Fixed codes: a match at the very start (length 3, distance 1), the unused length code 286.
  CHECK(deflate_fault(std::string("\x03\x02\0", 3)) == "a match before the start");
  CHECK(deflate_fault(std::string("\x1b\x03\0\0", 4)) == "an unknown code");
  // Dynamic codes: 30 more length codes than there are; code lengths that are all zero.
  CHECK(deflate_fault(std::string("\xf5\0\0", 3)) == "too many length codes");
  CHECK(deflate_fault(std::string("\x05\0\0\0\0\0\0\0\0\0\0\0", 12)) == "a damaged code table");
  for (std::size_t size = 2; size < zlibbed(content).size(); ++size)
    CHECK(fault(zlibbed(content).substr(0, size), Wrapping::zlib) == "an early end");
}

TEST_CASE("damaged data never goes unnoticed and never writes outside its buffer") {
  int unnoticed = 0, faults = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    DeflateWriter writer;
    const std::vector<Token> tokens = random_tokens(random, 1 + static_cast<int>(random.below(40)));
    writer.block(static_cast<DeflateWriter::Block>(random.below(3)), tokens, true, random);
    const std::string content = expand(tokens);
    const bool gzip = random.below(2) == 0;
    std::string data = writer.finish();
    data = gzip ? gzip_wrapped(data, content) : zlib_wrapped(data, content);
    const std::string intact = data;
    data = damaged(data, random);
    if (data == intact) continue;
    const Result result = run(data, gzip ? Wrapping::gzip : Wrapping::zlib, content.size());
    faults += result.inflated.fault != nullptr;
    // A change may hit bits that say nothing (a gzip header's time, padding), not the content.
    if (result.inflated.ended && result.content != content) {
      CAPTURE(seed);
      CHECK(result.content == content);
      ++unnoticed;
    }
  }
  CHECK(unnoticed == 0);
  CHECK(faults > 10000);
}
