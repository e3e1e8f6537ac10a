// SPDX-License-Identifier: MIT
#include "io/volume/dicom_slices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "io/files/text_scan.h"
#include "io/volume/dicom_series.h"
#include "io/volume/dicom_times.h"

namespace deliso {
namespace {

// The errors of a slice's place, in steps: the largest aside of the line of all slices, and the
// largest along it of even ones. Places are written with about three decimals, so they are not even
// to the last digit.
constexpr double kMostAside = 0.1, kUnevenSteps = 0.005;

// A wider gap, in usual ones, lacks a slice, unless there are several in a row: then slices lie
// that far apart from there on.
constexpr double kWideGap = 1.5;
constexpr std::size_t kWideGapsInRow = 3;

// Places that scatter by a length about a line come from slices whose whole shift may be an error
// of this many such lengths.
constexpr double kShiftOfScatter = 2;

std::string base_name(const DicomFile& file) {
  return std::filesystem::path(file.name()).filename().string();
}

// Refuses a file whose samples cannot be in a volume with those of `first`.
void require_same_kind(const DicomFile& file, const DicomFile& first) {
  if (!file.fault.empty()) fail(file.name(), file.fault);
  const auto refuse = [&](const std::string& fault) {
    fail(file.name(), fault, ", unlike '", base_name(first), "'");
  };
  if (file.type() != first.type()) refuse(text("has samples of type ", name_of(file.type())));
  if (file.photometric != first.photometric) refuse("is " + file.photometric);
}

void require_same_plane(const DicomSlice& slice, const DicomPlane& plane, const DicomFile& first,
                        const DicomPlane& wanted) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double spacing = (*plane.spacing)[axis], other = (*wanted.spacing)[axis];
    if (distance((*plane.directions)[axis], (*wanted.directions)[axis]) > kDirectionError) {
      fail(slice.name(), "has another orientation than '", base_name(first), "'");
    }
    if (std::abs(spacing - other) > kSpacingError * other) {
      fail(slice.name(), "has PixelSpacing ", spacing, ", unlike '", base_name(first), "' with ",
           other);
    }
  }
}

// True if the file gives the places of its frames for all of them together.
bool is_stack(const DicomFile& file) {
  return file.frame_count > 1 && file.planes.empty();
}

// Returns the distance of slices whose places are not given one by one, and notes one that is not
// meant for that. Its sign is the side to which they run.
double distance_of_slices(const VolumeInput& input, const DicomSlice& slice) {
  const DicomPlane plane = slice.plane();
  if (plane.distance) return *plane.distance;
  if (input.options.spacing) return input.options.spacing->z;
  if (!plane.thickness) {
    fail(slice.file->name(), "does not tell the distance of its ",
         slice.file->frame_count > 1 ? "frames" : "slices", " (SpacingBetweenSlices)",
         kGiveSpacing);
  }
  input.warn("slice-distance-guessed",
             "does not tell the distance of its slices: it is taken to be their thickness, ",
             *plane.thickness);
  return *plane.thickness;
}

// How the places of slices are found: by their positions; if no file has one, by their locations
// along the normal; else in the order of the instances.
enum class PlacedBy : std::uint8_t { position, location, order };

// Returns the plane of a slice with directions and spacing, which the user may give. Refuses one
// that is neither there nor given, unless all slices are `undirected`.
DicomPlane full_plane(const VolumeInput& input, const DicomSlice& slice, bool undirected) {
  DicomPlane plane = slice.plane();
  if (!plane.spacing) {
    if (!input.options.spacing) fail(slice.file->name(), "has no valid PixelSpacing", kGiveSpacing);
    plane.spacing = {input.options.spacing->x, input.options.spacing->y};
  }
  if (!plane.directions) {
    if (!undirected) fail(slice.file->name(), "has no ImageOrientationPatient");
    plane.directions = {Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  }
  if (!plane.is_right_angled()) {
    fail(slice.name(), "its ImageOrientationPatient is no pair of directions at right angles");
  }
  for (Vec3& direction : *plane.directions) direction = direction / length(direction);
  return plane;
}

// Sets the places of slices whose directions are not known upright along z: apart as their
// positions are, which run up.
void place_upright(std::vector<DicomSlice>& slices) {
  const auto [lowest, highest] =
      std::ranges::minmax(slices, {}, [](const DicomSlice& slice) { return slice.position.z; });
  const Vec3 begin = lowest.position, whole = highest.position - begin;
  if (!(whole.z > 0)) return;
  for (DicomSlice& slice : slices) {
    const double height = dot(slice.position - begin, whole) / length(whole);
    slice.position = begin + Vec3{0, 0, height};
  }
}

// Finds the places of slices, and sorts them by their heights.
void place(std::vector<DicomSlice>& slices, PlacedBy by, const VolumeInput& input,
           bool undirected) {
  const DicomFile& first = *slices[0].file;
  const DicomPlane wanted = full_plane(input, slices[0], undirected);
  const Vec3 normal = cross((*wanted.directions)[0], (*wanted.directions)[1]);
  const bool is_counted = by == PlacedBy::order || (is_stack(first) && first.frame_offsets.empty());
  const double step = is_counted ? distance_of_slices(input, slices[0]) : 0;
  for (DicomSlice& slice : slices) {
    const DicomFile& file = *slice.file;
    const DicomPlane plane = full_plane(input, slice, undirected);
    require_same_plane(slice, plane, first, wanted);
    const auto frame = static_cast<double>(slice.frame);
    if (by == PlacedBy::order) {
      slice.position = static_cast<double>(&slice - slices.data()) * step * normal;
    } else if (by == PlacedBy::location) {
      slice.position = *plane.location * normal;
    } else if (is_stack(file)) {
      const double number =
          file.frame_slices.empty() ? frame : file.frame_slices[slice.frame] - file.frame_slices[0];
      const double offset = file.frame_offsets.empty()
                                ? number * step
                                : file.frame_offsets[slice.frame] - file.frame_offsets[0];
      slice.position = plane.position.value_or(Vec3{}) + offset * normal;
    } else {
      if (!plane.position) fail(slice.name(), "has no ImagePositionPatient");
      slice.position = *plane.position;
    }
  }
  if (undirected) place_upright(slices);
  for (DicomSlice& slice : slices) slice.height = dot(slice.position, normal);
  std::ranges::stable_sort(slices, {}, &DicomSlice::height);
}

// True if all slices have an InstanceNumber, each its own.
bool have_own_numbers(const std::vector<DicomSlice>& slices) {
  std::set<double> numbers;
  for (const DicomSlice& slice : slices) {
    const std::optional<double> number = slice.plane().instance_number();
    if (!number || !numbers.insert(*number).second) return false;
  }
  return true;
}

// Returns all frames of all files, in the order of their places.
std::vector<DicomSlice> sorted_slices(const VolumeInput& input,
                                      const std::vector<DicomFile>& files) {
  std::vector<DicomSlice> slices;
  for (const DicomFile& file : files) {
    require_same_kind(file, files[0]);
    for (std::size_t n = 0; n < static_cast<std::size_t>(file.frame_count); ++n) {
      slices.push_back({.file = &file, .frame = n});
    }
  }
  const auto has = [](auto member) {
    return [member](const DicomSlice& slice) { return (slice.plane().*member).has_value(); };
  };
  const auto are_apart = [&] { return slices.back().height > slices[0].height; };
  const bool undirected = std::ranges::none_of(slices, has(&DicomPlane::directions));
  if (is_stack(files[0]) || std::ranges::any_of(slices, has(&DicomPlane::position))) {
    place(slices, PlacedBy::position, input, undirected);
    // Without directions the positions are read along z, and may not lie along it.
    if (!undirected || are_apart()) return slices;
  }
  if (std::ranges::all_of(slices, has(&DicomPlane::location))) {
    place(slices, PlacedBy::location, input, undirected);
    if (are_apart()) {
      input.note("slices-by-location",
                 "has no positions of its slices: they are placed by SliceLocation");
      return slices;
    }
  }
  const bool are_numbered = have_own_numbers(slices);
  std::ranges::stable_sort(slices, {}, [&](const DicomSlice& slice) {
    return std::pair(are_numbered ? slice.plane().instance_number() : std::nullopt,
                     with_long_numbers(slice.file->name()));
  });
  input.warn("slices-by-order",
             "has no positions of its slices: they are read in the order of their ",
             are_numbered ? "InstanceNumber" : "files' names");
  place(slices, PlacedBy::order, input, undirected);
  return slices;
}

// Warns of slices that seem to be missing.
void find_missing_slices(const VolumeInput& input, const std::vector<DicomSlice>& slices,
                         const std::vector<double>& gaps) {
  const double usual = usual_distance(slices);
  for (std::size_t begin = 0, end = 0; begin < gaps.size(); begin = end + 1) {
    for (end = begin; end < gaps.size() && gaps[end] > kWideGap * usual;) ++end;
    if (begin == end || end - begin >= kWideGapsInRow) continue;
    const DicomSlice &here = slices[begin + 1], &before = slices[begin];
    input.warn("slices-missing", "slices seem to be missing between ", name_beside(here, before),
               " and ", name_beside(before, here), ", which lie ", rounded_length(gaps[begin]),
               " apart, where others have ", rounded_length(usual),
               ": the mesh has nothing of what they show");
  }
}

// Makes the third step upright if the shift over the whole stack may be an error of positions that
// are rounded in the file. A tilt that they all follow stays. `scatter`: their largest distance
// from the line through the first one and the last.
void straighten(const VolumeInput& input, SampleGrid& grid, const Vec3& whole, double scatter) {
  Vec3 upright = grid.steps[2];
  double largest = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Vec3 direction = grid.steps[axis] / length(grid.steps[axis]);
    largest = std::max(largest, std::abs(dot(whole, direction)));
    upright = upright - dot(upright, direction) * direction;
  }
  if (largest <= kShearTolerance * length(whole) || largest > kShiftOfScatter * scatter) return;
  grid.steps[2] = upright;
  input.note("slices-straightened", "the last slice is shifted by ", rounded_length(largest),
             " against the first, as much as positions scatter: the stack is read upright");
}

// Sets the step from a slice to the next, and the places of slices that are uneven.
void set_step(DicomStack& stack, const VolumeInput& input) {
  const std::vector<DicomSlice>& slices = stack.slices;
  const std::vector<double> gaps = gaps_between(slices);
  if (!input.options.spacing) find_missing_slices(input, slices, gaps);
  const Vec3 begin = slices[0].position, whole = slices.back().position - begin;
  const double height = slices.back().height - slices[0].height;
  const double count = static_cast<double>(gaps.size());
  double worst = 0, scatter = 0;
  std::vector<double> places;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const double share = (slices[n].height - slices[0].height) / height;
    places.push_back(share * length(whole));
    const double aside = distance(slices[n].position, begin + share * whole);
    scatter = std::max(scatter, aside);
    if (aside > kMostAside * length(whole) / count) {
      fail(slices[n].name(), "lies ", rounded_length(aside),
           " aside of the line through the first slice and the last");
    }
    const double even = static_cast<double>(n) / count * length(whole);
    worst = std::max(worst, std::abs(places.back() - even));
  }
  SampleGrid& grid = stack.grid;
  grid.steps[2] = whole / count;
  straighten(input, grid, whole, scatter);
  const double step = length(grid.steps[2]);
  if (worst <= kUnevenSteps * step) return;
  if (input.options.spacing) {
    input.note("slices-off-steps", "slices lie up to ", rounded_length(worst),
               " from even steps of ", rounded_length(step),
               ", and are read as even, by --spacing");
    return;
  }
  const auto [least, most] = std::ranges::minmax(gaps);
  input.note("slices-uneven", "slices are uneven, from ", rounded_length(least), " to ",
             rounded_length(most),
             " apart, and stay so: a voxel is as long as the distance of its slices");
  const double upright = step * count / length(whole);
  for (const double place : places) grid.places[2].push_back(place * upright);
}

}  // namespace

std::string name_beside(const DicomSlice& slice, const DicomSlice& other) {
  std::string frame = other.file->frame_count == 1 ? "" : text("frame ", other.frame + 1);
  if (slice.file == other.file) return frame;
  return text("'", base_name(*other.file), frame.empty() ? "'" : "', ", frame);
}

DicomStack stack_of(const VolumeInput& input, const std::vector<DicomFile>& files) {
  DicomStack stack;
  stack.slices = sorted_slices(input, files);
  choose_time(input, stack.slices);
  const DicomSlice& lowest = stack.slices[0];
  const DicomPlane given = lowest.plane(), plane = full_plane(input, lowest, !given.directions);
  SampleGrid& grid = stack.grid = grid_of(input);
  grid.type = lowest.file->type();
  grid.byte_order = lowest.file->is_big_endian ? std::endian::big : std::endian::little;
  grid.dims = {lowest.file->columns, lowest.file->rows,
               static_cast<std::int64_t>(stack.slices.size())};
  data_size(grid);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    grid.steps[axis] = (*plane.spacing)[axis] * (*plane.directions)[axis];
  }
  set_step(stack, input);
  grid.origin = lowest.position;
  if (given.position && given.directions) grid.space = AnatomicalSpace::lps;
  if (!given.position || !given.directions) {
    const char* missing = given.position     ? "orientation"
                          : given.directions ? "position"
                                             : "position and orientation";
    input.warn("orientation-unknown", "does not tell its ", missing,
               ": world coordinates are not the patient's");
  }
  return stack;
}

}  // namespace deliso
