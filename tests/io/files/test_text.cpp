// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <string>

#include "io/files/base64.h"
#include "io/files/text_scan.h"
#include "io/volume/volume_files.h"

using namespace deliso;

namespace {

std::string decoded(std::string_view text, std::size_t at_most = 1000000) {
  const std::vector<std::byte> bytes = decode_base64(text, at_most);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

TEST_CASE("base64: RFC 4648's examples, random bytes, pieces one behind the other") {
  CHECK(decoded("") == "");
  CHECK(decoded("Zg==") == "f");
  CHECK(decoded("Zm8=") == "fo");
  CHECK(decoded("Zm9v") == "foo");
  CHECK(decoded("Zm9vYmFy") == "foobar");
  CHECK(decoded(" Zm\n9v\tYm Fy ") == "foobar");
  CHECK(decoded("Zm9vYmFy", 4) == "foob");
  CHECK(decoded("Zm9vYmFy</DataArray>") == "foobar");
  CHECK(decoded("Zm9vYm") == "foo");
  CHECK(decoded("Zm9v=g==") == "foo");
  CHECK(decoded("====") == "");
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    std::string text, expected;
    for (std::uint32_t pieces = 1 + random.below(3); pieces > 0; --pieces) {
      std::string bytes(random.below(50), '\0');
      for (char& c : bytes) c = static_cast<char>(random.below(256));
      const std::string piece = test::base64(bytes);
      REQUIRE(encode_base64(std::as_bytes(std::span(bytes))) == piece);
      text += piece;
      expected += bytes;
    }
    CAPTURE(seed);
    REQUIRE(decoded(text) == expected);
    const std::size_t part = random.below(static_cast<std::uint32_t>(expected.size() + 1));
    REQUIRE(decoded(text, part) == expected.substr(0, part));
  }
}

TEST_CASE("lines, words and numbers are parsed") {
  TextCursor text("a line\r\n\n  two   words\nlast");
  CHECK(text.line() == "a line");
  CHECK(text.line() == "");
  CHECK(text.word() == "two");
  CHECK(text.position() == 14);
  CHECK(text.line() == "   words");
  CHECK(text.line() == "last");
  CHECK(text.at_end());
  CHECK(text.line() == "");
  CHECK(text.word() == "");
  CHECK(trimmed(" \t a b \r\n") == "a b");
  CHECK(trimmed("  ") == "");
  CHECK(lower("NRRD Z") == "nrrd z");
  CHECK(to_int("-12") == -12);
  CHECK(to_int("+12") == 12);
  for (const char* bad : {"", " 1", "1 ", "1.0", "+-1", "--1", "+", "9223372036854775808", "0x10"})
    CHECK(!to_int(bad));
  CHECK(to_double("1e3") == 1000.0);
  CHECK(to_double("+.5") == 0.5);
  CHECK(std::isnan(*to_double("nan")));
  for (const char* bad : {"", "1,5", "1e999", "x", "+-1", "1f"}) CHECK(!to_double(bad));
  CHECK(to_ints(" 1 2\t3 ") == std::vector<std::int64_t>{1, 2, 3});
  CHECK(!to_ints("1 x"));
  CHECK(to_doubles("")->empty());
  CHECK(quote("a b") == "'a b'");
  CHECK(quote(std::string(100, 'x')) == "'" + std::string(60, 'x') + "...'");
}
