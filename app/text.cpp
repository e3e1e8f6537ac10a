// SPDX-License-Identifier: MIT
#include "app/text.h"

#include <charconv>
#include <cmath>
#include <filesystem>

namespace deliso {

std::string number_text(double value) {
  char digits[32];  // the longest double, -2.2250738585072014e-308, takes 24
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

std::string rounded(double value, int digits) {
  char text[48];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return std::string(text, end);
}

std::string about(double value) {
  return value < 10 ? rounded(value, 2) : grouped(static_cast<std::uint64_t>(std::round(value)));
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
  if (effective == isovalue || by_saddles) return number_text(isovalue);
  return number_text(isovalue) + ", lowered to " + number_text(effective) +
         " as samples may equal it";
}

std::string cost_text(double seconds, double bytes) {
  const double minutes = seconds / 60, hours = minutes / 60, mebibytes = bytes / (1 << 20);
  return (minutes < 2 ? about(seconds) + " seconds"
          : hours < 2 ? about(minutes) + " minutes"
                      : about(hours) + " hours") +
         " and " +
         (mebibytes < 1000 ? about(mebibytes) + " MiB" : about(mebibytes / 1024) + " GiB");
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return grouped(n) + " " + std::string(n == 1 ? one : many);
}

}  // namespace deliso
