// SPDX-License-Identifier: MIT
// Messages: what a file or an option holds cannot steer the terminal.
#include <doctest/doctest.h>

#include <string>

#include "base/check.h"

using namespace deliso;

TEST_CASE("control characters and bytes that are no UTF-8 become question marks") {
  CHECK(one_line("a\tb\x1b[31m\x7f\n") == "a?b?[31m??");
  CHECK(one_line("\xc2\x9b"
                 "31m \xc2\x80 \xc2\x9f") == "?31m ? ?");  // C1
  CHECK(one_line("\xc2\xa0 \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80") ==
        "\xc2\xa0 \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80");
  CHECK(one_line("\x9b"
                 "31m \xff \xc3") == "?31m ? ?");
  // Overlong: escape in two bytes, U+009B in three.
  CHECK(one_line("\xc0\x9b \xe0\x82\x9b") == "? ?");
  CHECK(std::string(InputError("name", "\xc2\x9b").what()) == "name?");
}

TEST_CASE("a very long message is cut, between characters too") {
  std::string message;
  for (int n = 0; n < 400; ++n) message += "\xe2\x82\xac";
  const std::string line = one_line(message);
  CHECK(line.size() < 520);
  CHECK(line.find("[...]") != std::string::npos);
  CHECK(one_line(line) == line);
}
