// SPDX-License-Identifier: MIT
#include "io/volume/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/text.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

// In a message, which has some 500 bytes.
constexpr std::uint64_t kSeriesListed = 5;

// Files whose images are of one series, size, orientation and spacing.
struct Stack {
  std::vector<DicomFile> files{};
  std::int64_t images = 0;

  const DicomFile& first() const { return files[0]; }
  // True unless the images are too few, in color, or without their places.
  bool may_be_volume() const {
    const DicomPlane plane = first().plane(0);
    const bool is_placed = (plane.position && plane.directions) || first().frame_count > 1;
    return images > 1 && first().is_gray() && plane.spacing && is_placed;
  }
};

// True unless the two cannot be in one volume. What a file does not tell, or tells wrongly, is
// refused later.
bool is_alike(const DicomFile& a, const DicomFile& b) {
  if (a.series != b.series || a.columns != b.columns || a.rows != b.rows) return false;
  const DicomPlane p = a.plane(0), q = b.plane(0);
  const bool has_directions =
      p.directions && q.directions && p.is_right_angled() && q.is_right_angled();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (has_directions &&
        distance((*p.directions)[axis], (*q.directions)[axis]) > kDirectionError) {
      return false;
    }
    if (p.spacing && q.spacing &&
        std::abs((*p.spacing)[axis] - (*q.spacing)[axis]) >
            kSpacingError * std::abs((*q.spacing)[axis])) {
      return false;
    }
  }
  return true;
}

std::vector<Stack> stacks_of(std::vector<DicomFile> files) {
  std::vector<Stack> stacks;
  for (DicomFile& file : files) {
    auto stack = std::ranges::find_if(
        stacks, [&](const Stack& other) { return is_alike(file, other.first()); });
    if (stack == stacks.end()) stack = stacks.insert(stack, Stack{});
    stack->images += file.frame_count;
    stack->files.push_back(std::move(file));
  }
  std::ranges::stable_sort(stacks, {},
                           [](const Stack& stack) { return stack.first().series_number; });
  return stacks;
}

std::string path_within(const VolumeInput& input, const DicomFile& file) {
  return std::filesystem::path(file.name()).lexically_relative(input.name()).string();
}

}  // namespace

ChosenSeries choose_series(const VolumeInput& input, std::vector<DicomFile> files) {
  std::vector<Stack> stacks = stacks_of(std::move(files));
  const bool has_volume = std::ranges::any_of(stacks, &Stack::may_be_volume);
  std::string list;
  std::uint64_t count = 0, number = input.options.series.value_or(1);
  Stack* chosen = nullptr;
  for (Stack& stack : stacks) {
    if (has_volume && !stack.may_be_volume()) continue;
    if (++count == number) chosen = &stack;
    if (count > kSeriesListed) continue;
    const DicomFile& first = stack.first();
    list += text(count > 1 ? "; " : "", count, " is ", quote(first.description), ", ", stack.images,
                 " images of ", first.columns, " x ", first.rows, " ('", path_within(input, first),
                 "')");
  }
  if (!chosen || (count > 1 && !input.options.series)) {
    const std::string more =
        count > kSeriesListed ? text("; and ", count - kSeriesListed, " more") : "";
    fail(input.name(), "holds ", count, " series, of which --series N takes one: ", list, more);
  }
  ChosenSeries series;
  std::size_t left_out = 0;
  for (const Stack& stack : stacks) {
    // Who chooses knows of the other series.
    if (&stack == chosen ||
        (input.options.series && stack.first().series != chosen->first().series))
      continue;
    if (left_out == 0) series.left_out = text("left out '", path_within(input, stack.first()), "'");
    left_out += stack.files.size();
  }
  if (left_out > 1) series.left_out += text(" and ", left_out - 1, " more");
  if (left_out > 0) series.left_out += ": of another series, size, spacing or orientation";
  series.files = std::move(chosen->files);
  return series;
}

}  // namespace deliso
