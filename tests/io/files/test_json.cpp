// SPDX-License-Identifier: MIT
#include "io/files/json.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#include "base/check.h"
#include "base/random.h"
#include "io/files/json_value.h"

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

TEST_CASE("strings are read with their escapes, and pairs of surrogates as one character") {
  const auto read = [](const std::string& text) {
    return parse_json("\"" + text + "\"", "in").string;
  };
  CHECK(read(R"(a\"\\\/\n)") == "a\"\\/\n");
  CHECK(read(R"(\u0041\u00e9\u20AC)") == "A\xc3\xa9\xe2\x82\xac");
  CHECK(read(R"(\ud83d\ude00!)") == "\xf0\x9f\x98\x80!");
  CHECK(read(R"(\udbff\udfff)") == "\xf4\x8f\xbf\xbf");
  const std::string no_character = "\xef\xbf\xbd";  // U+FFFD
  CHECK(read(R"(\ud83d)") == no_character);
  CHECK(read(R"(\ude00\ud83d)") == no_character + no_character);
  CHECK(read(R"(\ud83d\u0041)") == no_character + "A");
  CHECK(read(R"(\ud83d\n)") == no_character + "\n");
  for (const char* damaged : {R"(\u12)", R"(\u12g4)", R"(\u+123)", R"(\u)"}) {
    CHECK_THROWS_WITH_AS(read(damaged), doctest::Contains("\\u has no four digits"), InputError);
  }
  // What is written is read back.
  for (const std::string text : {"\xf0\x9f\x98\x80", "\x01\x1f\"\\", "\xe2\x82\xac"}) {
    CHECK(parse_json(member(text), "in").string == text);
  }
}

TEST_CASE("strings are escaped, and always valid UTF-8") {
  CHECK(member("a\"b\\c\n\x01") == "\"a\\\"b\\\\c\\u000a\\u0001\"");
  CHECK(member("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80") ==
        "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"");
  CHECK(member("\xff\xc3") == "\"\\ufffd\\ufffd\"");
  CHECK(member("\xe2\x82") == "\"\\ufffd\\ufffd\"");
  CHECK(member("") == "\"\"");
}
