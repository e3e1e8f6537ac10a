// SPDX-License-Identifier: MIT
// One of several volumes of a file: of its channels and its times, which the options count from 1.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/volume/read_volume.h"
#include "io/volume/sample_grid.h"

namespace deliso {

// The place of a volume, counted from 0.
struct VolumeChoice {
  std::int64_t channel = 0, time = 0;
};

// Returns the volume that the options choose. Throws InputError, with the file's `name`, if the
// file does not have it, or has several and the options choose none. `hint` ends that message.
VolumeChoice choose_volume(const std::string& name, const ReadOptions& options,
                           const VolumeCounts& counts, const std::string& hint = "");

// An axis of a file's data.
struct DataAxis {
  enum class Kind : std::uint8_t { x, y, z, channel, time };
  Kind kind;
  std::int64_t size;
};

// Sets the dimensions of the grid, and its place among the volumes of its data. `axes` has x, y and
// z, the fastest first; of channels and times there may be one axis each. Throws as
// choose_volume().
void set_axes(SampleGrid& grid, std::span<const DataAxis> axes, const std::string& hint = "");

}  // namespace deliso
