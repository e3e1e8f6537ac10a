// SPDX-License-Identifier: MIT
// What every volume header says in the end (how many samples of which type lie where) and the one
// way from that and the bytes of the data to a Volume. Each format's reader only fills in a
// SampleGrid and finds the bytes; every check that does not depend on the format is here.
//
// 1. No memory is taken for samples before the data is known to be long enough for them.
// 2. Bytes in native order, aligned for their type and cropped to whole slices at most are not
//    copied: the Volume refers to them and keeps their owner alive.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec3.h"
#include "io/files/inflate.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

struct SampleGrid {
  std::string name;  // of the input, whose faults those of the grid are
  std::optional<Roi> roi{};
  std::optional<BlockChoice> block{};
  std::array<std::int64_t, 3> dims{0, 0, 0};
  SampleType type = SampleType::u8;
  std::endian byte_order = std::endian::native;
  // World position of sample (0,0,0) and the step from a sample to the next along each file axis.
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> steps{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  AnatomicalSpace space = AnatomicalSpace::unknown;

  // Steps along the world's axes. Spacings are checked later, with the steps.
  void set_spacing(const Vec3& spacing);
};

// All of these throw InputError: in the name of the grid, or of the bytes where these are at fault.

// Checks the dimensions (2 or more each) and that the sizes fit the address space.
std::uint64_t data_size(const SampleGrid& grid);
// "64 x 64 x 32 uint16", for messages.
std::string describe(const SampleGrid& grid);

// `data` holds exactly the samples.
Volume volume_from_raw(const SampleGrid& grid, const Bytes& data);
// `data` holds the samples as numbers in text and nothing behind them unless `more_may_follow`.
Volume volume_from_text(const SampleGrid& grid, const Bytes& data, bool more_may_follow);
// `data` holds `skip` bytes and then exactly the samples, compressed.
Volume volume_from_compressed(const SampleGrid& grid, const Bytes& data, Wrapping wrapping,
                              std::uint64_t skip);

}  // namespace deliso
