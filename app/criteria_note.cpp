// SPDX-License-Identifier: MIT
#include "app/criteria_note.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "app/field.h"
#include "base/text.h"
#include "base/version.h"

namespace deliso {
namespace {

constexpr std::string_view kRMin = "r-min";
constexpr std::string_view kProgram = "deliso";

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(word.size());
  return word;
}

// Returns the number in `criteria` that a word of that name sets; null if the name is unknown.
double* place_of(Criteria& criteria, std::string_view name) {
  if (name == kRMin) return &criteria.r_min;
  const auto row = std::ranges::find(kCriterionTable, name, &CriterionRow::name);
  if (row == kCriterionTable.end()) return nullptr;
  return &criteria.limits.values[static_cast<std::size_t>(row - kCriterionTable.begin())];
}

std::optional<Criteria> criteria_in(std::string_view line) {
  if (take_word(line) != kProgram) return std::nullopt;
  take_word(line);  // the version
  Criteria criteria;
  criteria.limits.values.fill(kNotAsked);
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::size_t equals = word.find('=');
    double* const place = place_of(criteria, word.substr(0, equals));
    if (!place || equals == std::string_view::npos) continue;
    const std::string_view digits = word.substr(equals + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), *place);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!whole || !std::isfinite(*place) || *place <= 0) return std::nullopt;
  }
  if (!(criteria.r_min > 0) || !criteria.asks(Criterion::r_over_l)) return std::nullopt;
  for (std::size_t n = 0; n < kCriteria; ++n) {
    if (criteria.limits.values[n] < kCriterionTable[n].least) return std::nullopt;
  }
  return criteria;
}

}  // namespace

std::string criteria_note(const Criteria& criteria) {
  std::string line = text(kProgram, " ", kVersion, " ", kRMin, "=", criteria.r_min);
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const double limit = criteria.limits.values[n];
    if (limit < kNotAsked) line += text(" ", kCriterionTable[n].name, "=", limit);
  }
  return line;
}

std::optional<Criteria> noted_criteria(std::span<const std::string> comments) {
  for (const std::string& comment : comments) {
    if (auto criteria = criteria_in(comment)) return criteria;
  }
  return std::nullopt;
}

std::string criteria_note(const CommandLine& line, const Volume& volume) {
  const Options& options = line.options;
  const std::string field = field_note(line.field, volume);
  if (options.stop_after_recover) {
    return text(kProgram, " ", kVersion, " stop-after=recover", field);
  }
  const double voxel = volume.voxel();
  // Lengths that were given in voxels stay as they are, to the last digit.
  const auto in_voxels = [&](const Length& length) {
    return length.unit == Length::Unit::voxel ? length.value : length.in(volume) / voxel;
  };
  Criteria criteria;
  criteria.r_min = in_voxels(options.r_min);
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const Length& limit = options.limits.values[n];
    criteria.limits.values[n] = kCriterionTable[n].is_length ? in_voxels(limit) : limit.value;
  }
  if (by_count(options)) criteria[Criterion::distance] = kNotAsked;
  return criteria_note(criteria) + field;
}

}  // namespace deliso
