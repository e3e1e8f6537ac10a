// SPDX-License-Identifier: MIT
#include "app/parse_value.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>

#include "base/check.h"

namespace deliso {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view wanted) {
  throw InputError(std::string(option) + " wants " + std::string(wanted) + ", not '" +
                   std::string(text) + "'");
}

template <class Number>
std::optional<Number> read_all(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> read_finite(std::string_view text) {
  const auto value = read_all<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Splits at `separator` into exactly three parts.
std::optional<std::array<std::string_view, 3>> split3(std::string_view text, char separator) {
  const std::size_t first = text.find(separator);
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = text.find(separator, first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(second + 1);
  if (rest.find(separator) != std::string_view::npos) return std::nullopt;
  return std::array{text.substr(0, first), text.substr(first + 1, second - first - 1), rest};
}

}  // namespace

double parse_number(std::string_view option, std::string_view text) {
  const auto value = read_finite(text);
  if (!value) refuse(option, text, "a finite number");
  return *value;
}

double parse_positive(std::string_view option, std::string_view text) {
  const auto value = read_finite(text);
  if (!value || *value <= 0) refuse(option, text, "a number above 0");
  return *value;
}

std::uint64_t parse_count(std::string_view option, std::string_view text, std::uint64_t least) {
  const auto value = read_all<std::uint64_t>(text);
  if (!value || *value < least) {
    refuse(option, text, "a whole number from " + std::to_string(least) + " up");
  }
  return *value;
}

RelativeLength parse_relative_length(std::string_view option, std::string_view text) {
  constexpr std::string_view kUnit = "vox";
  const bool in_voxels = text.ends_with(kUnit);
  const auto value = read_finite(in_voxels ? text.substr(0, text.size() - kUnit.size()) : text);
  if (!value || *value <= 0) refuse(option, text, "a fraction above 0 or voxels as in '0.5vox'");
  return {*value, in_voxels};
}

Vec3 parse_spacing(std::string_view option, std::string_view text) {
  const auto parts = split3(text, ',');
  Vec3 spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = parts ? read_finite((*parts)[static_cast<std::size_t>(axis)]) : std::nullopt;
    if (!value || *value <= 0) refuse(option, text, "three numbers above 0 as in '1,1,2.5'");
    spacing[axis] = *value;
  }
  return spacing;
}

}  // namespace deliso
