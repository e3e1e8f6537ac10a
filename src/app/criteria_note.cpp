// SPDX-License-Identifier: MIT
#include "app/criteria_note.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "base/text.h"
#include "base/version.h"

namespace deliso {
namespace {

struct Word {
  std::string_view name;
  double NotedCriteria::*value;
  bool needed;  // for a check to judge by the line
};
constexpr std::array kWords{Word{"max-distance", &NotedCriteria::max_distance, false},
                            Word{"r-min", &NotedCriteria::r_min, true},
                            Word{"lambda", &NotedCriteria::lambda, true},
                            Word{"eps1", &NotedCriteria::epsilon1, false},
                            Word{"eps2", &NotedCriteria::epsilon2, false},
                            Word{"max-radius", &NotedCriteria::max_radius, false}};
constexpr std::string_view kProgram = "deliso";

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(word.size());
  return word;
}

std::optional<NotedCriteria> criteria_in(std::string_view line) {
  if (take_word(line) != kProgram) return std::nullopt;
  take_word(line);  // the version
  NotedCriteria criteria;
  std::array<bool, kWords.size()> seen{};
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::size_t equals = word.find('=');
    const std::string_view name = word.substr(0, equals);
    const auto known = std::ranges::find(kWords, name, &Word::name);
    if (known == kWords.end() || equals == std::string_view::npos) continue;
    const std::string_view digits = word.substr(equals + 1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!whole || !std::isfinite(value) || value <= 0) return std::nullopt;
    criteria.*known->value = value;
    seen[static_cast<std::size_t>(known - kWords.begin())] = true;
  }
  for (std::size_t n = 0; n < kWords.size(); ++n) {
    if (kWords[n].needed && !seen[n]) return std::nullopt;
  }
  return criteria.lambda < 1 ? std::nullopt : std::optional(criteria);
}

}  // namespace

std::string criteria_note(const NotedCriteria& criteria) {
  std::string line = text(kProgram, " ", kVersion);
  for (const Word& word : kWords) {
    const double value = criteria.*word.value;
    if (value < NotedCriteria::kNone) line += text(" ", word.name, "=", value);
  }
  return line;
}

std::optional<NotedCriteria> noted_criteria(std::span<const std::string> comments) {
  for (const std::string& comment : comments) {
    if (auto criteria = criteria_in(comment)) return criteria;
  }
  return std::nullopt;
}

std::string criteria_note(const CommandLine& line, const Volume& volume, const Report& report) {
  const Options& options = line.options;
  if (options.method == Method::marching_cubes) {
    return text(kProgram, " ", kVersion, " method=marching-cubes");
  }
  if (options.stop_after_recover) return text(kProgram, " ", kVersion, " stop-after=recover");
  const Vec3 spacing = volume.spacing();
  const double voxel = std::min({spacing.x, spacing.y, spacing.z});
  // Lengths that were given in voxels stay as they are, to the last digit.
  const auto in_voxels = [&](const Length& length) {
    return length.unit == Length::Unit::voxel ? length.value : length.in(volume) / voxel;
  };
  NotedCriteria criteria;
  criteria.max_distance =
      by_count(options) ? report.max_distance / voxel : in_voxels(options.max_distance);
  criteria.r_min = in_voxels(options.r_min);
  criteria.lambda = options.lambda;
  criteria.epsilon1 = options.epsilon1;
  criteria.epsilon2 = options.epsilon2;
  criteria.max_radius = options.max_radius / voxel;
  return criteria_note(criteria);
}

}  // namespace deliso
