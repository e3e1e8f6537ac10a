// SPDX-License-Identifier: MIT
#include "app/criteria_note.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/field.h"
#include "base/text.h"
#include "base/version.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr std::string_view kRMin = "r-min", kFree = "free-vertices";
constexpr std::string_view kProgram = "deliso";

// Returns the number in `criteria` that a word of that name sets; null if the name is unknown.
double* place_of(Criteria& criteria, std::string_view name) {
  if (name == kRMin) return &criteria.r_min;
  if (name == kFree) return &criteria.free_vertices;
  const auto row = std::ranges::find(kCriterionTable, name, &CriterionRow::name);
  if (row == kCriterionTable.end()) return nullptr;
  return &criteria.limits.values[static_cast<std::size_t>(row - kCriterionTable.begin())];
}

std::optional<Criteria> criteria_in(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);  // the second is the version
  if (words.empty() || words[0] != kProgram) return std::nullopt;
  Criteria criteria;
  criteria.limits.values.fill(kNotAsked);
  for (std::size_t n = 2; n < words.size(); ++n) {
    const std::size_t equals = words[n].find('=');
    double* const place = place_of(criteria, words[n].substr(0, equals));
    if (!place || equals == std::string_view::npos) continue;
    *place = to_double(words[n].substr(equals + 1)).value_or(0);
    if (!std::isfinite(*place) || *place <= 0) return std::nullopt;
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
  if (criteria.free_vertices > 0) line += text(" ", kFree, "=", criteria.free_vertices);
  return line;
}

std::optional<Criteria> noted_criteria(std::span<const std::string> comments) {
  for (const std::string& comment : comments) {
    if (auto criteria = criteria_in(comment)) return criteria;
  }
  return std::nullopt;
}

std::string criteria_note(const CommandLine& line, const Grid& volume) {
  const Options& options = line.options;
  const std::string field = field_note(line.field, volume);
  if (options.stop_after_stage1) {
    return text(kProgram, " ", kVersion, " stop-after=stage1", field);
  }
  const double voxel = volume.voxel();
  // Lengths that were given in voxels stay as they are, to the last digit.
  const auto in_voxels = [&](const Length& length) {
    return length.unit == Length::Unit::voxel ? length.value : length.in(volume) / voxel;
  };
  Criteria criteria;
  criteria.r_min = in_voxels(options.r_min);
  criteria.free_vertices = in_voxels(options.free_vertices);
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const Length& limit = options.limits.values[n];
    criteria.limits.values[n] = kCriterionTable[n].is_length ? in_voxels(limit) : limit.value;
  }
  if (by_count(options)) criteria[Criterion::distance] = kNotAsked;
  const std::string eps2 = line.paper ? text(" eps2=", line.published.epsilon2) : "";
  return criteria_note(criteria) + eps2 + field;
}

}  // namespace deliso
