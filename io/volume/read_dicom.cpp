// SPDX-License-Identifier: MIT
// A volume from DICOM: the slices of a series, one file each, or the frames of one file (PS3.3,
// C.7.6.2 and C.7.6.16). The slices are ordered by their places along the normal of their planes.
// World coordinates are the patient's, LPS+ in millimeters.
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/volume/dicom_file.h"
#include "io/volume/dicom_series.h"
#include "io/volume/sample_grid.h"
#include "io/volume/scaled_samples.h"
#include "io/volume/upright_volume.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

// The errors of a slice's place, in steps: the largest that is read, and the largest without a
// note. Places are written with about three decimals, so they are not even to the last digit.
constexpr double kUnevenSteps = 0.1, kNotedSteps = 0.005;

// A frame of a file. Its plane is computed when needed: frames may be many and small.
struct Slice {
  const DicomFile* file = nullptr;
  std::size_t frame = 0;
  Vec3 position{};
  double height = 0;  // along the normal

  DicomPlane plane() const { return file->plane(frame); }
  double slope() const { return plane().slope.value_or(1); }
  double intercept() const { return plane().intercept.value_or(0); }
  std::string name() const {
    return file->frame_count == 1 ? file->name() : text(file->name(), ", frame ", frame + 1);
  }
};

// A length for a message.
double rounded(double length) {
  return std::round(length * 1e4) / 1e4;
}

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

// Returns the plane of a frame with its place, which the file may give for all frames together.
// Refuses a plane that is not given.
DicomPlane placed_plane(const Slice& slice) {
  const DicomFile& file = *slice.file;
  DicomPlane plane = slice.plane();
  if (!plane.spacing) fail(file.name(), "has no PixelSpacing");
  const bool is_stack = file.frame_count > 1 && file.planes.empty();
  if (!plane.directions) {
    if (!is_stack) fail(file.name(), "has no ImageOrientationPatient");
    plane.directions = {Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  }
  if (!plane.is_right_angled()) {
    fail(slice.name(), "its ImageOrientationPatient is no pair of directions at right angles");
  }
  auto& [x, y] = *plane.directions;
  x = x / length(x);
  y = y / length(y);
  if (is_stack) {
    if (file.frame_offsets.empty() && !plane.distance) {
      fail(file.name(), "does not tell the distance of its frames (SpacingBetweenSlices)");
    }
    const double number = file.frame_slices.empty()
                              ? static_cast<double>(slice.frame)
                              : file.frame_slices[slice.frame] - file.frame_slices[0];
    const double offset = file.frame_offsets.empty()
                              ? number * *plane.distance
                              : file.frame_offsets[slice.frame] - file.frame_offsets[0];
    plane.position = plane.position.value_or(Vec3{}) + offset * cross(x, y);
  }
  if (!plane.position) fail(slice.name(), "has no ImagePositionPatient");
  return plane;
}

void require_same_plane(const Slice& slice, const DicomPlane& plane, const DicomFile& first,
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

// Returns all frames of all files, in the order of their places.
std::vector<Slice> sorted_slices(const std::vector<DicomFile>& files) {
  std::vector<Slice> slices;
  const DicomPlane wanted = placed_plane({&files[0], 0});
  const Vec3 normal = cross((*wanted.directions)[0], (*wanted.directions)[1]);
  for (const DicomFile& file : files) {
    require_same_kind(file, files[0]);
    for (std::size_t frame = 0; frame < static_cast<std::size_t>(file.frame_count); ++frame) {
      Slice slice{&file, frame};
      const DicomPlane plane = placed_plane(slice);
      require_same_plane(slice, plane, files[0], wanted);
      slice.position = *plane.position;
      slice.height = dot(slice.position, normal);
      slices.push_back(slice);
    }
  }
  std::ranges::stable_sort(slices, {}, &Slice::height);
  return slices;
}

// Returns the step from a slice to the next. Refuses slices that are missing, that are there twice,
// or whose places are uneven, and notes those that are so a little.
Vec3 step_between(const VolumeInput& input, const std::vector<Slice>& slices) {
  const std::size_t count = slices.size() - 1;
  const Vec3 begin = slices[0].position;
  const Vec3 step = (slices[count].position - begin) / static_cast<double>(count);
  std::vector<double> gaps;
  for (std::size_t n = 0; n < count; ++n) gaps.push_back(slices[n + 1].height - slices[n].height);
  const double mean = (slices[count].height - slices[0].height) / static_cast<double>(count);
  const auto refuse = [&](std::size_t n, const std::string& fault) {
    const Slice &here = slices[n + 1], &before = slices[n];
    const std::string frame = before.file->frame_count == 1 ? "" : text("frame ", before.frame + 1);
    const bool is_same = before.file == here.file;
    const std::string file =
        is_same ? "" : text("'", base_name(*before.file), frame.empty() ? "'" : "', ");
    fail(here.name(), fault, " ", file, frame);
  };
  for (std::size_t n = 0; n < count; ++n) {
    if (gaps[n] <= 0.01 * mean) refuse(n, "has the same place (ImagePositionPatient) as");
  }
  std::vector<double> ordered = gaps;
  const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::ranges::nth_element(ordered, middle);
  for (std::size_t n = 0; n < count; ++n) {
    if (gaps[n] > 1.5 * *middle) {
      refuse(n, text("slices are missing before it: it lies ", rounded(gaps[n]),
                     ", where others have ", rounded(*middle), ", from"));
    }
  }
  double worst = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3 even = begin + static_cast<double>(n + 1) * step;
    const double error = distance(slices[n + 1].position, even);
    if (error > kUnevenSteps * length(step)) {
      fail(slices[n + 1].name(), "lies ", rounded(error), " from its place in even steps of ",
           rounded(length(step)), ": resample the series");
    }
    worst = std::max(worst, error);
  }
  if (worst > kNotedSteps * length(step)) {
    input.note("slices lie up to ", rounded(worst), " from the even steps of ",
               rounded(length(step)), " with which they are read");
  }
  return step;
}

// Returns the volume of the slices, whose grid but for the type is `grid`.
Volume volume_of_slices(const VolumeInput& input, const std::vector<DicomFile>& files,
                        const std::vector<Slice>& slices, SampleGrid grid) {
  const DicomFile& first = *slices[0].file;
  const bool is_scaled = std::ranges::any_of(
      slices, [](const Slice& slice) { return slice.slope() != 1 || slice.intercept() != 0; });
  const auto is_in_place = [&](const Slice& slice) {
    return slice.frame == static_cast<std::size_t>(&slice - slices.data());
  };
  if (files.size() == 1 && first.is_plain() && !is_scaled &&
      std::ranges::all_of(slices, is_in_place)) {
    return volume_from_raw(grid,
                           {first.name(), first.pixels.first(data_size(grid)), first.bytes.owner});
  }
  if (!is_scaled) {
    return volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
      slices[k].file->write_frame(slices[k].frame, out);
    });
  }
  const bool is_small = first.bits_allocated <= 16;
  grid.type = is_small ? SampleType::f32 : SampleType::f64;
  const std::size_t count = first.frame_size() / size_of(first.type());
  Buffer stored(first.frame_size());
  const auto write = [&](std::size_t k, std::span<std::byte> out) {
    const double slope = slices[k].slope(), intercept = slices[k].intercept();
    slices[k].file->write_frame(slices[k].frame, stored.span());
    with_type(first.type(), [&]<class T>(T) {
      const T* samples = reinterpret_cast<const T*>(stored.data.get());
      if (is_small) write_scaled<float>(samples, count, slope, intercept, out.data());
      if (!is_small) write_scaled<double>(samples, count, slope, intercept, out.data());
    });
  };
  const bool is_even = std::ranges::all_of(slices, [&](const Slice& slice) {
    return slice.slope() == slices[0].slope() && slice.intercept() == slices[0].intercept();
  });
  const std::string how =
      is_even ? text(" (", slices[0].slope(), " * sample + ", slices[0].intercept(), ")")
              : ", slice by slice,";
  input.note("samples are rescaled as the files ask", how, " and held as ", name_of(grid.type));
  return volume_from_slices(grid, write);
}

Volume read_slices(const VolumeInput& input, const std::vector<DicomFile>& files) {
  if (files.size() == 1 && files[0].frame_count == 1) {
    fail(files[0].name(), "is one slice: give the folder that holds the series");
  }
  const std::vector<Slice> slices = sorted_slices(files);
  const DicomFile& first = *slices[0].file;
  const DicomPlane plane = placed_plane(slices[0]);
  SampleGrid grid = grid_of(input);
  grid.type = first.type();
  grid.byte_order = first.is_big_endian ? std::endian::big : std::endian::little;
  grid.dims = {first.columns, first.rows, static_cast<std::int64_t>(slices.size())};
  std::uint64_t stored = 0;
  for (const DicomFile& file : files) stored += file.bytes.size();
  input.options.budget.require(input.name(), stored, data_size(grid));
  grid.set_spacing({(*plane.spacing)[0], (*plane.spacing)[1], 1});
  for (std::size_t axis = 0; axis < 2; ++axis) {
    grid.steps[axis] = grid.steps[axis][static_cast<int>(axis)] * (*plane.directions)[axis];
  }
  grid.steps[2] = step_between(input, slices);
  grid.origin = slices[0].position;
  const DicomPlane given = slices[0].plane();
  if (given.directions) grid.space = AnatomicalSpace::lps;
  if (!given.position || !given.directions) {
    const char* missing = given.position     ? "orientation"
                          : given.directions ? "position"
                                             : "position and orientation";
    input.note("does not tell its ", missing, ": world coordinates are not the patient's");
  }
  if (first.photometric == "MONOCHROME1") {
    input.note("is MONOCHROME1: small samples are shown bright; they are kept as stored");
  }
  const SampleGrid upright = upright_grid(grid);
  if (upright.steps[2] == grid.steps[2]) return volume_of_slices(input, files, slices, grid);
  SampleGrid whole = upright;
  whole.read = {};
  return resampled_upright(input, grid, volume_of_slices(input, files, slices, whole));
}

}  // namespace

Volume read_dicom_series(const VolumeInput& input, std::vector<DicomFile> files) {
  const ChosenSeries series = choose_series(input, std::move(files));
  if (series.left_out.empty()) return read_slices(input, series.files);
  input.note(series.left_out);
  try {
    return read_slices(input, series.files);
  } catch (const InputError& error) {
    throw InputError(error.what(), " (", series.left_out, ")");
  }
}

Volume read_dicom(const VolumeInput& input) {
  std::vector<DicomFile> files;
  if (auto file = parse_dicom(input.bytes)) files.push_back(std::move(*file));
  const std::filesystem::path path(input.name());
  if (files.empty() && lower(path.filename().string()) == "dicomdir") {
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    return read_folder({{folder, {}, nullptr}, input.directory, input.options, input.log});
  }
  if (files.empty()) fail(input.name(), "is DICOM without an image");
  return read_dicom_series(input, std::move(files));
}

}  // namespace deliso
