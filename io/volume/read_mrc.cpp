// SPDX-License-Identifier: MIT
// MRC files and CCP4 maps, of electron microscopy and crystallography, as the standard of 2014 has
// them. A binary header of 1024 bytes, in either byte order, an extended header and the samples.
// Lengths are in angstroms.
#include <array>
#include <cmath>
#include <cstdint>

#include "base/elementary.h"
#include "io/files/field_reader.h"
#include "io/volume/sample_grid.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

constexpr std::size_t kMrcHeader = 1024;

// Where the header has its fields, by their names in the standard. Fields have four bytes, and
// those for three axes follow each other.
constexpr std::size_t kNx = 0, kMode = 12, kNxStart = 16, kMx = 28, kCellA = 40, kCellB = 52,
                      kMapC = 64, kIspg = 88, kNsymbt = 92, kImodStamp = 152, kImodFlags = 156,
                      kOrigin = 196, kMap = 208;

template <class T>
std::array<T, 3> three(const FieldReader& fields, std::size_t offset) {
  return {fields.get<T>(offset), fields.get<T>(offset + 4), fields.get<T>(offset + 8)};
}

SampleType sample_type(const VolumeInput& input, const FieldReader& fields) {
  const auto mode = fields.get<std::int32_t>(kMode);
  // IMOD's bytes have no sign, but where a flag says so.
  const bool is_unsigned = fields.get<std::uint32_t>(kImodStamp) == 1146047817 &&
                           fields.get<std::uint32_t>(kImodFlags) % 2 == 0;
  if (mode == 0) return is_unsigned ? SampleType::u8 : SampleType::i8;
  if (mode == 1) return SampleType::i16;
  if (mode == 2) return SampleType::f32;
  if (mode == 6) return SampleType::u16;
  fail(input.name(), "MRC mode ", mode,
       " is not supported (0, 1, 2 and 6 are): convert 16-bit floats with python3 -c \"import "
       "mrcfile; m = mrcfile.open('FILE'); mrcfile.write('volume.mrc', m.data.astype('f4'), "
       "voxel_size=m.voxel_size)\"");
}

// Returns the directions of the cell's axes: X is the world's x, Y is in its xy-plane.
std::array<Vec3, 3> cell_axes(const FieldReader& fields) {
  // 90 degrees have no cosine of 6e-17. Some writers leave the angles 0.
  const auto cosine_at = [&](std::size_t offset) {
    const double degrees = fields.get<float>(offset);
    const bool is_right = !(degrees > 0 && degrees < 180) || degrees == 90;
    return is_right ? 0 : cosine(degrees * (3.14159265358979323846 / 180));
  };
  const double yz = cosine_at(kCellB), xz = cosine_at(kCellB + 4), xy = cosine_at(kCellB + 8);
  const double sine = std::sqrt(1 - xy * xy), zy = (yz - xz * xy) / sine;
  return {Vec3{1, 0, 0}, Vec3{xy, sine, 0}, Vec3{xz, zy, std::sqrt(1 - xz * xz - zy * zy)}};
}

// Sets the steps by the unit cell, which is divided into MX x MY x MZ intervals, and the origin:
// the field ORIGIN or, if that is 0, the place in the cell where the samples begin.
void read_geometry(const VolumeInput& input, const FieldReader& fields, SampleGrid& grid) {
  const auto cell = three<float>(fields, kCellA);
  const auto intervals = three<std::int32_t>(fields, kMx);
  auto along = three<std::int32_t>(fields, kMapC);  // 1 for X, and so on
  if (along == std::array{0, 0, 0}) along = {1, 2, 3};
  Vec3 spacing;
  std::array<Vec3, 3> directions;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto axis = static_cast<std::size_t>(along[n]) - 1;
    if (axis > 2) fail(input.name(), "axis ", n + 1, " of it is ", along[n], ", not X, Y or Z");
    spacing[static_cast<int>(n)] = cell[axis] / static_cast<double>(intervals[axis]);
    directions[n] = cell_axes(fields)[axis];
  }
  grid.set_spacing(spacing);
  const auto start = three<std::int32_t>(fields, kNxStart);
  for (std::size_t n = 0; n < 3; ++n) {
    grid.steps[n] = grid.steps[n][static_cast<int>(n)] * directions[n];
    grid.origin = grid.origin + start[n] * grid.steps[n];
  }
  const auto [x, y, z] = three<float>(fields, kOrigin);
  if (x != 0 || y != 0 || z != 0) grid.origin = {x, y, z};
}

}  // namespace

bool looks_like_mrc(const Bytes& bytes) {
  const Bytes start = start_of(bytes, kMap + 4);
  return start.size() == kMap + 4 && start.text().ends_with("MAP ");
}

Volume read_mrc(const VolumeInput& input) {
  const Bytes header = start_of(input.bytes, kMrcHeader);
  if (header.size() < kMrcHeader) fail(input.name(), "ends within its header");
  SampleGrid grid = grid_of(input);
  // Read in the wrong byte order, a number of columns is 65536 or more. The field for the order,
  // MACHST, is empty or wrong in files of some programs.
  const FieldReader native(header.data, std::endian::native);
  if (native.get<std::uint32_t>(kNx) > 65535) grid.byte_order = kSwappedOrder;
  const FieldReader fields(header.data, grid.byte_order);
  grid.type = sample_type(input, fields);
  const auto [nx, ny, nz] = three<std::int32_t>(fields, kNx);
  // By its space group it may be a stack of volumes, with MZ sections in each.
  const auto mz = fields.get<std::int32_t>(kMx + 8);
  const bool is_stack = fields.get<std::int32_t>(kIspg) > 400 && mz > 0 && nz % mz == 0;
  using Kind = DataAxis::Kind;
  const DataAxis z{Kind::z, is_stack ? mz : nz}, time{Kind::time, is_stack ? nz / mz : 1};
  set_axes(grid, std::array{DataAxis{Kind::x, nx}, DataAxis{Kind::y, ny}, z, time});
  read_geometry(input, fields, grid);
  const auto extended = fields.get<std::int32_t>(kNsymbt);
  if (extended < 0) fail(input.name(), "has an extended header of ", extended, " bytes");
  return volume_behind(grid, input.bytes, kMrcHeader + static_cast<std::uint64_t>(extended));
}

}  // namespace deliso
