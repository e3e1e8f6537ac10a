// SPDX-License-Identifier: MIT
#include "io/files/json.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <limits>

#include "base/random.h"

using namespace deliso;

namespace {

// The text of one member "k" of an otherwise empty object.
template <class T>
std::string member(const T& value) {
  JsonWriter json;
  json.add("k", value);
  const std::string text = json.finish();
  const std::string before = "{\n  \"k\": ", after = "\n}\n";
  REQUIRE(text.starts_with(before));
  REQUIRE(text.ends_with(after));
  return text.substr(before.size(), text.size() - before.size() - after.size());
}

}  // namespace

TEST_CASE("objects nest, members are separated, keys keep their order") {
  JsonWriter json;
  json.add("a", 1);
  json.open("b");
  json.add("c", true);
  json.open("empty");
  json.close();
  json.add("d", {0.5, 2.0});
  json.close();
  json.add("e", "text");
  CHECK(json.finish() ==
        "{\n  \"a\": 1,\n  \"b\": {\n    \"c\": true,\n    \"empty\": {},\n    \"d\": [0.5, 2]\n  "
        "},\n  \"e\": \"text\"\n}\n");
  CHECK(JsonWriter().finish() == "{}\n");
}

TEST_CASE("lists of objects") {
  JsonWriter json;
  json.open_list("none");
  json.close();
  json.open_list("some");
  json.open_item();
  json.add("a", 1);
  json.close();
  json.open_item();
  json.close();
  json.close();
  json.add("b", 2);
  CHECK(json.finish() ==
        "{\n  \"none\": [],\n  \"some\": [\n    {\n      \"a\": 1\n    },\n    {}\n  ],\n  \"b\": "
        "2\n}\n");
}

TEST_CASE("numbers read back the same; numbers that JSON lacks become null") {
  for (std::uint64_t seed = 1; seed <= 10000; ++seed) {
    Random random(seed);
    const std::uint64_t bits = random.next();
    double value = 0;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (!(value - value == 0)) continue;
    CAPTURE(seed);
    const std::string text = member(value);
    CHECK(std::strtod(text.c_str(), nullptr) == value);
    CHECK(text.find_first_not_of("-+.0123456789e") == std::string::npos);
  }
  CHECK(member(std::numeric_limits<double>::infinity()) == "null");
  CHECK(member(std::numeric_limits<double>::quiet_NaN()) == "null");
  CHECK(member(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
  CHECK(member(std::int64_t{-5}) == "-5");
}

TEST_CASE("strings are escaped, and always valid UTF-8") {
  CHECK(member("a\"b\\c\n\x01") == "\"a\\\"b\\\\c\\u000a\\u0001\"");
  CHECK(member("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80") ==
        "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"");
  CHECK(member("\xff\xc3") == "\"\\ufffd\\ufffd\"");
  CHECK(member("\xe2\x82") == "\"\\ufffd\\ufffd\"");
  CHECK(member("") == "\"\"");
}
