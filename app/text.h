// SPDX-License-Identifier: MIT
// Numbers and file names in the program's texts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace deliso {

std::string rounded(double value, int digits = 4);  // to this number of significant digits
std::string fixed(double value, int decimals);
std::string grouped(std::uint64_t n);             // 1234567 -> "1,234,567"
std::string short_name(const std::string& file);  // of the file alone; "standard input" for -
// "128, lowered to 127.9999990463257 as samples may equal it". A value that only saddles may equal
// is told alone.
std::string isovalue_text(double isovalue, double effective);
// Returns "1 vertex"; `many` is `one` with an s, unless it is given.
std::string counted(std::uint64_t n, std::string_view one, std::string_view many = {});

}  // namespace deliso
