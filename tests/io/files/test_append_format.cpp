// SPDX-License-Identifier: MIT
#include "io/files/append_format.h"

#include <doctest/doctest.h>

#include <string>

using namespace deliso;

TEST_CASE("text of any length is appended whole, after what was there") {
  for (const int length : {0, 1, 15, 16, 511, 512, 513, 5000}) {
    CAPTURE(length);
    const std::string word(static_cast<std::size_t>(length), 'w');
    std::string text = "before ";
    append_format(text, "%s", word.c_str());
    CHECK(text == "before " + word);
    append_format(text, "|%5d|%-4s|%.2f", 42, "ab", 2.5);
    CHECK(text == "before " + word + "|   42|ab  |2.50");
  }
}
