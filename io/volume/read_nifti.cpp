// SPDX-License-Identifier: MIT
// NIfTI-1 and NIfTI-2 (nifti1.h and nifti2.h of the NIfTI Data Format Working Group). The binary
// header has 348 or 540 bytes, in either byte order, in the file of the data or beside it.
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files/field_reader.h"
#include "io/volume/sample_grid.h"
#include "io/volume/scaled_samples.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kHeader1 = 348, kHeader2 = 540;

// The fields that both versions of the header have.
struct NiftiHeader {
  std::endian order = std::endian::native;
  bool in_one_file = true;
  std::int64_t dim[8]{};
  int datatype = 0;
  double pixdim[8]{};
  double data_offset = 0;
  double slope = 0, intercept = 0;
  int qform_code = 0, sform_code = 0, units = 0;
  double qform[6]{};  // a quaternion and the origin
  double srow[12]{};  // three rows of four
};

// The offsets of its fields in a version.
struct NiftiOffsets {
  std::size_t dim, datatype, pixdim, data, slope, intercept, units, qform_code, sform_code, qform,
      srow;
};
constexpr NiftiOffsets kOffsets1{40, 70, 76, 108, 112, 116, 123, 252, 254, 256, 280},
    kOffsets2{16, 12, 104, 168, 176, 184, 500, 344, 348, 352, 400};

// The types are those of the fields in the version.
template <class Real, class Size, class Offset, class Units, class Code>
NiftiHeader parse_version(const FieldReader& fields, const NiftiOffsets& at) {
  NiftiHeader h;
  const auto read_reals = [&](std::size_t offset, std::span<double> to) {
    for (std::size_t n = 0; n < to.size(); ++n)
      to[n] = static_cast<double>(fields.get<Real>(offset + n * sizeof(Real)));
  };
  for (std::size_t n = 0; n < 8; ++n) h.dim[n] = fields.get<Size>(at.dim + n * sizeof(Size));
  h.datatype = fields.get<std::int16_t>(at.datatype);
  read_reals(at.pixdim, h.pixdim);
  h.data_offset = static_cast<double>(fields.get<Offset>(at.data));
  h.slope = static_cast<double>(fields.get<Real>(at.slope));
  h.intercept = static_cast<double>(fields.get<Real>(at.intercept));
  h.units = fields.get<Units>(at.units);
  h.qform_code = fields.get<Code>(at.qform_code);
  h.sform_code = fields.get<Code>(at.sform_code);
  read_reals(at.qform, h.qform);
  read_reals(at.srow, h.srow);
  return h;
}

// Returns the header at the start of `bytes`; nullopt if there is none.
std::optional<NiftiHeader> parse_header(std::span<const std::byte> bytes) {
  if (bytes.size() < kHeader1) return std::nullopt;
  for (const std::endian order : {std::endian::native, kSwappedOrder}) {
    const FieldReader fields(bytes, order);
    const auto size = fields.get<std::uint32_t>(0);
    if (size != kHeader1 && (size != kHeader2 || bytes.size() < kHeader2)) continue;
    const bool is_first = size == kHeader1;
    using I16 = std::int16_t;
    using I32 = std::int32_t;
    using I64 = std::int64_t;
    NiftiHeader h = is_first
                        ? parse_version<float, I16, float, std::uint8_t, I16>(fields, kOffsets1)
                        : parse_version<double, I64, I64, I32, I32>(fields, kOffsets2);
    h.order = order;
    const std::string_view magic(reinterpret_cast<const char*>(bytes.data()) + (is_first ? 344 : 4),
                                 4);
    h.in_one_file = magic == (is_first ? "n+1\0"sv : "n+2\0"sv);
    if (h.in_one_file || magic == (is_first ? "ni1\0"sv : "ni2\0"sv)) return h;
  }
  return std::nullopt;
}

StoredType sample_type(const VolumeInput& input, int datatype) {
  using Wide = StoredType::Wide;
  constexpr std::pair<int, StoredType> kTypes[] = {
      {2, SampleType::u8},   {4, SampleType::i16},  {8, SampleType::i32},   {16, SampleType::f32},
      {64, SampleType::f64}, {256, SampleType::i8}, {512, SampleType::u16}, {768, SampleType::u32},
      {1024, Wide::i64},     {1280, Wide::u64}};
  for (const auto& [number, type] : kTypes) {
    if (number == datatype) return type;
  }
  if (datatype == 128 || datatype == 2304)
    fail(input.name(), "is in color (RGB", datatype == 128 ? "" : "A",
         "): only grayscale can be meshed");
  fail(input.name(), "NIfTI datatype ", datatype,
       " is not supported (integers of 8 to 64 bits, float32, float64 are)");
}

// nifti1.h, "Orientation and location in space": method 3 (sform) if given, else method 2 (qform),
// else method 1 (the spacings alone).
void read_geometry(const VolumeInput& input, const NiftiHeader& h, SampleGrid& grid) {
  if (h.sform_code > 0) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      grid.steps[axis] = {h.srow[axis], h.srow[4 + axis], h.srow[8 + axis]};
    grid.origin = {h.srow[3], h.srow[7], h.srow[11]};
    grid.space = AnatomicalSpace::ras;
    return;
  }
  grid.set_spacing({h.pixdim[1], h.pixdim[2], h.pixdim[3]});
  if (h.qform_code <= 0) {
    input.note(
        "orientation-unknown",
        "its qform and sform codes are 0: by the standard's method 1, sample (0, 0, 0) is at the "
        "origin, and no space is known");
    return;
  }
  double b = h.qform[0], c = h.qform[1], d = h.qform[2];
  double a = 1 - (b * b + c * c + d * d);
  if (a < 1e-7) {  // a half turn: rounding must not leave it a non-unit quaternion
    const double scale = 1 / std::sqrt(b * b + c * c + d * d);
    b *= scale;
    c *= scale;
    d *= scale;
    a = 0;
  } else {
    a = std::sqrt(a);
  }
  const double flip = h.pixdim[0] < 0 ? -1 : 1;
  const Vec3 axes[3] = {{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
                        {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
                        {flip * 2 * (b * d + a * c), flip * 2 * (c * d - a * b),
                         flip * (a * a + d * d - b * b - c * c)}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.steps[axis] = grid.steps[axis][static_cast<int>(axis)] * axes[axis];
  grid.origin = {h.qform[3], h.qform[4], h.qform[5]};
  grid.space = AnatomicalSpace::ras;
}

// Converts lengths in meters or micrometers: RAS+ is in millimeters, for viewers and for writers.
void to_millimeters(const VolumeInput& input, const NiftiHeader& h, SampleGrid& grid) {
  constexpr int kMeter = 1, kMicrometer = 3, kOfSpace = 7;
  const int unit = h.units & kOfSpace;
  if (unit != kMeter && unit != kMicrometer) return;
  const auto convert = [&](Vec3& v) { v = unit == kMeter ? 1000 * v : v / 1000; };
  convert(grid.origin);
  for (Vec3& step : grid.steps) convert(step);
  input.note("unit-converted", "lengths are in millimeters, the header's in ",
             unit == kMeter ? "meters" : "micrometers");
}

SampleGrid read_grid(const VolumeInput& input, const NiftiHeader& h) {
  SampleGrid grid = grid_of(input);
  grid.type = sample_type(input, h.datatype);
  grid.byte_order = h.order;
  if (h.dim[0] < 3 || h.dim[0] > 7)
    fail(input.name(), "has ", h.dim[0],
         " dimensions: only three-dimensional volumes can be meshed");
  for (std::int64_t n = 6; n <= h.dim[0]; ++n) {
    if (h.dim[n] == 1) continue;
    fail(input.name(), "dimension ", n, " has size ", h.dim[n],
         ": only channels (5) and times (4) can be told apart");
  }
  const auto size = [&](std::int64_t n) { return n <= h.dim[0] ? h.dim[n] : 1; };
  using Kind = DataAxis::Kind;
  set_axes(grid, std::array{DataAxis{Kind::x, h.dim[1]}, DataAxis{Kind::y, h.dim[2]},
                            DataAxis{Kind::z, h.dim[3]}, DataAxis{Kind::time, size(4)},
                            DataAxis{Kind::channel, size(5)}});
  read_geometry(input, h, grid);
  to_millimeters(input, h, grid);
  return grid;
}

// "a.hdr" or "a.hdr.gz" -> "a.img", or "a.img.gz" if only that is there.
Bytes open_image_file(const VolumeInput& input) {
  const std::size_t slash = input.name().rfind('/');
  std::string stem = input.name().substr(slash == std::string::npos ? 0 : slash + 1);
  for (std::string_view end : {".gz", ".hdr"})
    if (stem.ends_with(end)) stem.resize(stem.size() - end.size());
  std::error_code ignored;
  const bool plain = std::filesystem::exists(input.directory + stem + ".img", ignored);
  const bool packed = std::filesystem::exists(input.directory + stem + ".img.gz", ignored);
  return open_data_file(input, stem + (packed && !plain ? ".img.gz" : ".img"));
}

bool is_scaled(const NiftiHeader& h) {
  return h.slope != 0 && (h.slope != 1 || h.intercept != 0);
}

Volume apply_scaling(const VolumeInput& input, const NiftiHeader& h, const Volume& volume) {
  if (!is_scaled(h)) return volume;
  if (!std::isfinite(h.slope)) {
    input.note("slope-not-finite", "scl_slope is not finite; the samples are taken as stored");
    return volume;
  }
  if (!std::isfinite(h.intercept)) fail(input.name(), "scl_inter is not finite");
  return scaled_volume(input, volume, h.slope, h.intercept);
}

}  // namespace

bool looks_like_nifti(const Bytes& bytes) {
  return parse_header(start_of(bytes, kHeader2).data).has_value();
}

Volume read_nifti(const VolumeInput& input) {
  // Without a header it has a type that is none.
  const auto header = parse_header(start_of(input.bytes, kHeader2).data).value_or(NiftiHeader());
  SampleGrid grid = read_grid(input, header);
  // Numbers of ids have no scale.
  if (is_scaled(header) && std::isfinite(header.slope)) grid.read.as_labels = false;

  const Bytes data = header.in_one_file ? input.bytes : open_image_file(input);
  const double offset = header.data_offset;
  const double smallest = header.in_one_file ? static_cast<double>(kHeader1) : 0;
  if (!(offset >= smallest && offset <= 0x1p52) || offset != std::floor(offset))
    fail(input.name(), "vox_offset ", std::to_string(offset), " is not valid");
  return apply_scaling(input, header,
                       volume_behind(grid, data, static_cast<std::uint64_t>(offset)));
}

}  // namespace deliso
