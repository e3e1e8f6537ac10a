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
#include "io/volume/dicom_slices.h"
#include "io/volume/sample_grid.h"
#include "io/volume/scaled_samples.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

// Returns the volume of the slices, whose grid but for the type is `grid`.
Volume volume_of_slices(const VolumeInput& input, const std::vector<DicomFile>& files,
                        const std::vector<DicomSlice>& slices, SampleGrid grid) {
  const DicomFile& first = *slices[0].file;
  const bool is_scaled = std::ranges::any_of(
      slices, [](const DicomSlice& slice) { return slice.slope() != 1 || slice.intercept() != 0; });
  const auto is_in_place = [&](const DicomSlice& slice) {
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
  const bool is_even = std::ranges::all_of(slices, [&](const DicomSlice& slice) {
    return slice.slope() == slices[0].slope() && slice.intercept() == slices[0].intercept();
  });
  const std::string how =
      is_even ? text(" (", slices[0].slope(), " * sample + ", slices[0].intercept(), ")")
              : ", slice by slice,";
  input.note("rescaled", "samples are rescaled as the files ask", how, " and held as ",
             name_of(grid.type));
  return volume_from_slices(grid, write);
}

void note_padding(const VolumeInput& input, const std::vector<DicomFile>& files) {
  std::size_t count = 0, most = 0;
  const DicomFile* first = nullptr;
  for (const DicomFile& file : files) {
    // An odd number of bytes is padded to an even one.
    if (file.padding() <= 1) continue;
    if (count++ == 0) first = &file;
    most = std::max(most, file.padding());
  }
  if (count == 0) return;
  const std::string name = std::filesystem::path(first->name()).filename().string();
  input.note("bytes-after-samples", "'", name,
             count > 1 ? text("' and ", count - 1, " more have") : "' has", " up to ", most,
             " bytes behind the samples, which are not read");
}

Volume read_slices(const VolumeInput& input, const std::vector<DicomFile>& files) {
  const DicomFile& first = files[0];
  if (files.size() == 1 && first.is_segmentation()) return read_dicom_segmentation(input, first);
  if (!first.fault.empty()) fail(first.name(), first.fault);
  if (files.size() == 1 && first.frame_count == 1) {
    fail(first.name(), "is one slice: give the folder that holds the series");
  }
  const auto [slices, grid] = stack_of(input, files);
  std::uint64_t stored = 0;
  for (const DicomFile& file : files) stored += file.bytes.size();
  input.options.budget.require(input.name(), stored, data_size(grid));
  note_padding(input, files);
  if (first.photometric == "MONOCHROME1") {
    input.note("inverted-gray",
               "is MONOCHROME1: small samples are shown bright; they are kept as stored");
  }
  return volume_of_slices(input, files, slices, grid);
}

}  // namespace

Volume read_dicom_series(const VolumeInput& input, std::vector<DicomFile> files) {
  const ChosenSeries series = choose_series(input, std::move(files));
  if (series.left_out.empty()) return read_slices(input, series.files);
  input.note("series-left-out", series.left_out);
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
  if (files.empty()) {
    fail(input.name(),
         "is DICOM without an image; contours (RTSTRUCT) become a segmentation in 3D Slicer");
  }
  return read_dicom_series(input, std::move(files));
}

}  // namespace deliso
