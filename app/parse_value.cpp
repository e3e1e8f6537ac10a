// SPDX-License-Identifier: MIT
#include "app/parse_value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>

#include "base/check.h"
#include "base/sorted_list.h"
#include "io/files/text_scan.h"
#include "view/render/font.h"

namespace deliso {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view wanted) {
  throw InputError(option, " wants ", wanted, ", not '", text, "'");
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

// Splits at `separator` into exactly N parts and parses each.
template <class Number, std::size_t N>
std::optional<std::array<Number, N>> read_list(std::string_view text, char separator) {
  std::array<Number, N> numbers;
  const std::vector<std::string_view> parts = split(text, separator);
  if (parts.size() != N) return std::nullopt;
  for (std::size_t n = 0; n < N; ++n) {
    const auto value = read_all<Number>(parts[n]);
    if (!value || !std::isfinite(static_cast<double>(*value))) return std::nullopt;
    numbers[n] = *value;
  }
  return numbers;
}

ClipChoice parse_clip(std::string_view option, std::string_view text) {
  if (const auto plane = read_list<double, 4>(text, ',')) {
    const Vec3 normal{(*plane)[0], (*plane)[1], (*plane)[2]};
    if (normal != Vec3{}) return {0, 1, false, ClipPlane{normal, (*plane)[3]}};
  }
  ClipChoice clip;
  std::string_view rest = text;
  clip.keep_above = rest.starts_with('-');
  if (clip.keep_above) rest.remove_prefix(1);
  const auto fraction =
      rest.size() > 2 && rest[1] == ':' ? read_finite(rest.substr(2)) : std::nullopt;
  if (!fraction || *fraction < 0 || *fraction > 1 || rest[0] < 'x' || rest[0] > 'z') {
    refuse(option, text, "an axis and a fraction as in 'x:0.5' or '-x:0.5', or a plane 'a,b,c,d'");
  }
  clip.axis = rest[0] - 'x';
  clip.fraction = *fraction;
  return clip;
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

PartChoice parse_part(std::string_view option, std::string_view text) {
  const auto numbers = read_list<int, 2>(text, '/');
  if (!numbers || (*numbers)[0] < 1 || (*numbers)[0] > (*numbers)[1]) {
    refuse(option, text, "N/M with N from 1 to M, as in '3/64'");
  }
  return {(*numbers)[0], (*numbers)[1]};
}

Length parse_length(std::string_view option, std::string_view text, Length::Unit unit,
                    bool may_be_zero) {
  constexpr std::string_view kUnit = "vox";
  const bool in_voxels = text.ends_with(kUnit);
  const auto value = read_finite(in_voxels ? text.substr(0, text.size() - kUnit.size()) : text);
  if (!value || *value < 0 || (*value == 0 && !may_be_zero)) {
    refuse(option, text,
           std::string(may_be_zero ? "0, or a number above it" : "a number above 0") +
               ", or voxels as in '0.5vox'");
  }
  return {*value, in_voxels ? Length::Unit::voxel : unit};
}

LabelList parse_label_list(std::string_view option, std::string_view text) {
  LabelList labels;
  for (const std::string_view word : split(text, ',')) {
    if (word.find_first_not_of("+-. 0123456789") != word.npos) {
      labels.names.emplace_back(word);
      continue;
    }
    const auto label = read_all<std::int64_t>(word);
    if (!label) {
      refuse(option, text,
             "whole numbers below 2^63 as in '1' or '1,4', names of the file's segments, or all");
    }
    labels.numbers.push_back(*label);
  }
  sort_unique(labels.numbers);
  return labels;
}

Vec3 parse_spacing(std::string_view option, std::string_view text) {
  const auto list = read_list<double, 3>(text, ',');
  if (!list || !((*list)[0] > 0 && (*list)[1] > 0 && (*list)[2] > 0)) {
    refuse(option, text, "three numbers above 0 as in '1,1,2.5'");
  }
  return {(*list)[0], (*list)[1], (*list)[2]};
}

Vec3 parse_point(std::string_view option, std::string_view text) {
  const auto list = read_list<double, 3>(text, ',');
  if (!list) refuse(option, text, "three numbers as in '1,-2,2.5'");
  return {(*list)[0], (*list)[1], (*list)[2]};
}

View parse_view(std::string_view option, std::string_view text) {
  const auto list = read_list<double, 2>(text, ',');
  if (!list || std::abs((*list)[0]) > 360 || std::abs((*list)[1]) > 90) {
    refuse(option, text, "an azimuth and an elevation in degrees as in '30,25'");
  }
  return {(*list)[0], (*list)[1]};
}

double parse_zoom(std::string_view option, std::string_view text) {
  const double zoom = parse_positive(option, text), largest = largest_zoom({1, 1});
  if (zoom > largest) {
    refuse(option, text, "at most " + std::to_string(static_cast<int>(largest)));
  }
  return zoom;
}

double parse_angle_of_view(std::string_view option, std::string_view text) {
  const double angle = parse_positive(option, text);
  if (angle < 1 || angle > 120) refuse(option, text, "degrees from 1 to 120");
  return angle;
}

PictureSize parse_picture_size(std::string_view option, std::string_view text) {
  const auto list = read_list<int, 2>(text, 'x');
  if (!list || std::min((*list)[0], (*list)[1]) < 1 ||
      std::max((*list)[0], (*list)[1]) > kLargestSide) {
    refuse(option, text,
           "two numbers of pixels from 1 to " + std::to_string(kLargestSide) + " as in '800x600'");
  }
  return {(*list)[0], (*list)[1]};
}

std::vector<std::optional<ClipChoice>> parse_clips(std::string_view option, std::string_view text) {
  std::vector<std::optional<ClipChoice>> clips;
  for (const std::string_view word : split(text, '/')) {
    clips.push_back(word == "off" ? std::nullopt : std::optional(parse_clip(option, word)));
  }
  return clips;
}

std::string parse_drawable(std::string_view option, std::string_view text) {
  if (!is_drawable(text)) refuse(option, text, "printable characters of ASCII");
  return std::string(text);
}

std::vector<std::string> parse_labels(std::string_view option, std::string_view given) {
  const std::string text = parse_drawable(option, given);
  const std::vector<std::string_view> labels = split(text, '/');
  return {labels.begin(), labels.end()};
}

Vec3 parse_color(std::string_view option, std::string_view text) {
  if (text == "white") return {1, 1, 1};
  if (text == "black") return {0, 0, 0};
  unsigned number = 0;
  const char *begin = text.data() + 1, *end = text.data() + text.size();
  if (text.size() != 7 || text[0] != '#' || std::from_chars(begin, end, number, 16).ptr != end) {
    refuse(option, text, "white, black or a color as in '#20242c'");
  }
  const auto part = [number](int shift) { return (number >> shift & 0xff) / 255.0; };
  return {part(16), part(8), part(0)};
}

}  // namespace deliso
