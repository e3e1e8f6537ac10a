// SPDX-License-Identifier: MIT
#include "app/text.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "io/files/append_format.h"

namespace deliso {

std::string rounded(double value, int digits) {
  char text[48];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return std::string(text, end);
}

std::string fixed(double value, int decimals) {
  std::string digits;
  append_format(digits, "%.*f", decimals, value);
  return digits;
}

std::string grouped(std::uint64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

std::string short_name(const std::string& file) {
  return file == "-" ? "standard input" : std::filesystem::path(file).filename().string();
}

std::string isovalue_text(double isovalue, double effective) {
  // Half-way between integers no sample of an integer type lies.
  const bool by_saddles = isovalue - std::floor(isovalue) == 0.5;
  if (effective == isovalue || by_saddles) return text(isovalue);
  return text(isovalue, effective < isovalue ? ", lowered to " : ", raised to ", effective,
              " as samples may equal it");
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return text(grouped(n), " ", n == 1 || many.empty() ? one : many,
              n == 1 || !many.empty() ? "" : "s");
}

}  // namespace deliso
