// SPDX-License-Identifier: MIT
// The slices of one volume: the frames of a series in the order of their places, and of several
// times the one that the options choose.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.h"
#include "io/volume/dicom_file.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {

// A frame of a file. Its plane is computed when needed: frames may be many and small.
struct DicomSlice {
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
inline double rounded_length(double length) {
  return std::round(length * 1e4) / 1e4;
}

// Returns the name of `other` in a message about `slice`.
std::string name_beside(const DicomSlice& slice, const DicomSlice& other);

struct DicomStack {
  std::vector<DicomSlice> slices;
  SampleGrid grid;
};

// Returns the slices of these files, which are of one series. Throws InputError if they make no
// volume, and notes what is not as it should be.
DicomStack stack_of(const VolumeInput& input, const std::vector<DicomFile>& files);

}  // namespace deliso
