// SPDX-License-Identifier: MIT
#include "io/volume/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "base/text.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

// Bytes of a list in a message, with the folder's name, and of one description. A message has some
// 500.
constexpr std::size_t kLongestList = 380, kLongestName = 40;

// Files whose images are of one series, size, orientation and spacing.
struct Stack {
  std::vector<DicomFile> files{};
  std::int64_t images = 0;

  const DicomFile& first() const { return files[0]; }
  // Returns how doubtful it is that the images are a volume, from 0 on, and why, if that is not
  // plain.
  std::pair<int, const char*> doubt() const {
    const DicomPlane plane = first().plane(0);
    const bool is_placed = (plane.position && plane.directions) || first().frame_count > 1;
    if (images < 2) return {2, ""};
    if (!first().is_gray()) return {2, "in color"};
    if (!plane.spacing) return {1, "no PixelSpacing"};
    if (!is_placed) return {1, "no positions"};
    return {0, ""};
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
  std::ranges::stable_sort(stacks, {}, [](const Stack& stack) {
    return std::pair(stack.doubt().first, stack.first().series_number);
  });
  return stacks;
}

std::string path_within(const VolumeInput& input, const DicomFile& file) {
  return std::filesystem::path(file.name()).lexically_relative(input.name()).string();
}

// Returns the files without images that are there twice, as in an export beside another one.
std::vector<DicomFile> without_copies(const VolumeInput& input, std::vector<DicomFile> files) {
  // Some programs give all images of a series the same name: then they have different places.
  const auto is_same = [](const DicomFile& a, const DicomFile& b) {
    const DicomPlane p = a.plane(0), q = b.plane(0);
    return p.position == q.position && p.moment == q.moment &&
           (p.position || std::ranges::equal(a.pixels, b.pixels));
  };
  std::vector<DicomFile> kept;
  std::map<std::string, std::size_t> places;  // of instances in `kept`
  std::string note;
  for (DicomFile& file : files) {
    const auto [known, is_new] = places.try_emplace(file.instance, kept.size());
    if (is_new || file.instance.empty() || !is_same(file, kept[known->second])) {
      kept.push_back(std::move(file));
    } else if (note.empty()) {
      note = text("left out '", path_within(input, file), "', the same image (SOPInstanceUID) as '",
                  path_within(input, kept[known->second]), "'");
    }
  }
  const std::size_t more = files.size() - kept.size();
  if (more > 0)
    input.note("copies-left-out", note, more > 1 ? text(", and ", more - 1, " more copies") : "");
  return kept;
}

FoundSeries found_series(const VolumeInput& input, const Stack& stack) {
  const DicomFile& first = stack.first();
  return {first.description, path_within(input, first), stack.images, first.columns,
          first.rows,        stack.doubt().second};
}

[[noreturn]] void refuse_choice(const VolumeInput& input, const std::vector<Stack>& stacks) {
  std::vector<FoundSeries> found;
  found.reserve(stacks.size());
  for (const Stack& stack : stacks) found.push_back(found_series(input, stack));
  std::string list;
  std::size_t listed = 0;
  for (; listed < found.size(); ++listed) {
    const std::string line =
        text(listed > 0 ? "; " : "", listed + 1, " is ", text_of(found[listed]));
    if (listed > 0 && input.name().size() + list.size() + line.size() > kLongestList) break;
    list += line;
  }
  if (listed < found.size()) {
    list += text("; and ", found.size() - listed, " more, which 'deliso info' lists");
  }
  throw SeveralSeries(std::move(found), input.name(), ": holds ", stacks.size(),
                      " series, of which --series N takes one: ", list);
}

}  // namespace

std::string text_of(const FoundSeries& series) {
  std::string name = series.description;
  if (name.size() > kLongestName) name = name.substr(0, kLongestName - 3) + "...";
  return one_line(text(quote(name), ", ", series.images, series.images == 1 ? " image" : " images",
                       " of ", series.columns, " x ", series.rows, series.doubt.empty() ? "" : ", ",
                       series.doubt, " ('", series.file, "')"));
}

ChosenSeries choose_series(const VolumeInput& input, std::vector<DicomFile> files) {
  std::vector<Stack> stacks = stacks_of(without_copies(input, std::move(files)));
  // The only one among the least doubtful.
  const bool is_clear = stacks.size() == 1 || stacks[0].doubt().first < stacks[1].doubt().first;
  const std::uint64_t number = input.options.series.value_or(1);
  if ((!is_clear && !input.options.series) || number < 1 || number > stacks.size()) {
    refuse_choice(input, stacks);
  }
  const Stack* const chosen = &stacks[number - 1];
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
  series.files = std::move(stacks[number - 1].files);
  return series;
}

}  // namespace deliso
