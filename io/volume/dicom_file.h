// SPDX-License-Identifier: MIT
// One DICOM file (PS3.5, PS3.10): of its data set only what a volume is made of. Explicit and
// implicit VR, either byte order, deflated or not, samples plain, in RLE, lossless JPEG or JPEG-LS;
// files without a preamble too.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// What tells frames at one place apart, as of several times or echoes. Numbers that only grow come
// last: they may differ from slice to slice.
inline constexpr std::array<std::string_view, 8> kMomentNames = {
    "TemporalPositionIdentifier", "TriggerTime",     "EchoTime",    "DiffusionBValue",
    "AcquisitionNumber",          "AcquisitionTime", "ContentTime", "InstanceNumber"};
using DicomMoment = std::array<std::optional<double>, kMomentNames.size()>;

// The place of a frame, and the meaning of its samples, as far as they are given.
struct DicomPlane {
  std::optional<Vec3> position{};                   // of the first sample
  std::optional<std::array<Vec3, 2>> directions{};  // of x, along a row, and of y
  std::optional<std::array<double, 2>> spacing{};   // along x and y, positive
  std::optional<double> distance{};                 // SpacingBetweenSlices, not 0
  std::optional<double> thickness{};                // SliceThickness, positive
  std::optional<double> location{};                 // SliceLocation
  std::optional<double> slope{}, intercept{};
  std::optional<int> segment{};  // the number of the frame's
  DicomMoment moment{};
  // The days of AcquisitionTime and ContentTime, as YYYYMMDD; 0 where not given. The times of
  // `moment` are counted with them, so that they go on after midnight.
  std::array<double, 2> days{};

  std::optional<double> instance_number() const { return moment.back(); }

  // pre: directions.
  bool is_right_angled() const {
    const auto& [x, y] = *directions;
    return std::abs(length(x) - 1) <= 0.01 && std::abs(length(y) - 1) <= 0.01 &&
           std::abs(dot(x, y)) <= 0.01;
  }
};

enum class DicomCoding : std::uint8_t { plain, rle, jpeg };

struct DicomFile {
  Bytes bytes;
  std::string fault;     // why the samples are not read, or empty
  std::string series;    // SeriesInstanceUID
  std::string instance;  // SOPInstanceUID
  std::string description;
  std::int64_t series_number = std::numeric_limits<std::int64_t>::max();  // without one it is last
  std::string photometric;
  std::string image_type;
  std::string grid_owner, grid_slices;  // of a mosaic of United Imaging
  std::string segmentation_type;        // of a segmentation: BINARY, FRACTIONAL or LABELMAP
  std::vector<NamedSegment> segments;
  int columns = 0, rows = 0;
  std::int64_t frame_count = 1;
  int samples_per_pixel = 1;
  int bits_allocated = 0, bits_stored = 0, high_bit = 0;
  int is_signed = 0;      // or 1
  int padding_value = 0;  // of a map of labels: of slices without a frame
  DicomCoding coding = DicomCoding::plain;
  bool is_big_endian = false;
  bool is_swapped_bytes = false;  // 8-bit samples in big-endian words of 16 bits

  DicomPlane common;                  // of all frames
  std::vector<DicomPlane> planes;     // one per frame, or none
  std::vector<double> frame_offsets;  // along the normal, or none
  std::vector<int> frame_slices;      // of nuclear medicine, the numbers of their slices; or none

  // If they are plain; there may be more of them than the frames need.
  std::span<const std::byte> pixels;
  // Else of each frame; only JPEG has several for one frame.
  std::vector<std::vector<std::span<const std::byte>>> fragments;

  const std::string& name() const { return bytes.name; }
  bool is_segmentation() const { return !segmentation_type.empty(); }
  // Old files do not tell that they are gray.
  bool is_gray() const {
    return samples_per_pixel == 1 && (photometric.empty() || photometric.starts_with("MONOCHROME"));
  }
  SampleType type() const;
  std::size_t frame_size() const {
    return size_of(type()) * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
  // Returns the number of bytes behind the samples.
  std::size_t padding() const {
    return coding == DicomCoding::plain
               ? pixels.size() - frame_size() * static_cast<std::size_t>(frame_count)
               : 0;
  }
  // Returns the frame's plane, with what all frames have in common.
  DicomPlane plane(std::size_t frame) const;
  // True if the stored samples are those of `type()`, in one piece.
  bool is_plain() const {
    return coding == DicomCoding::plain && bits_stored == bits_allocated && bits_allocated > 1 &&
           !is_swapped_bytes;
  }
  // Fills `out` with the samples of a frame in native order. pre: out.size() == frame_size().
  void write_frame(std::size_t frame, std::span<std::byte> out) const;
};

// Returns nullopt if the file has no image. Throws InputError if it is damaged.
std::optional<DicomFile> parse_dicom(const Bytes& bytes);

}  // namespace deliso
