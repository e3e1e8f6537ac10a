// SPDX-License-Identifier: MIT
// Labels: a segmentation gives every sample the whole number of its material. The indicator of some
// labels is 1 at their samples and 0 elsewhere; smoothed, it has a surface around them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "volume/volume.h"
#include "volume/volume_source.h"

namespace deliso {

inline constexpr double kLabelsEnd = 0x1p63;  // labels are below it, and not below its negative

// The samples of a segmentation. If there are `ids`, ascending, sample n has label ids[n]; else a
// sample is its label.
struct Segmentation {
  Segmentation(const Volume& samples, const std::vector<std::int64_t>& labels = {})
      : volume(samples), ids(labels) {}

  Volume volume;
  std::vector<std::int64_t> ids;
};

// One label's samples.
struct LabelSamples {
  std::int64_t label = 0;
  std::uint64_t samples = 0;
  // In usual voxels, within the domain box: a sample on a face of the box has half a voxel there,
  // on an edge a quarter.
  double volume = 0;
  SampleBox box;      // the smallest around them
  double weight = 0;  // of its indicator (io/filter/label_fields.h); 0: not known
};

// True if the value is a whole number of 64 bits.
template <class T>
bool is_label(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    return value >= -kLabelsEnd && value < kLabelsEnd && std::floor(value) == value;
  }
  return true;
}

// Returns all labels of the volume, or of a box of its samples, in their order. Throws InputError,
// with the volume's `name`, for the first sample that is no whole number of 64 bits. The result is
// the same with any number of threads.
std::vector<LabelSamples> find_labels(const Segmentation& samples, std::string_view name,
                                      int threads = 1, const std::optional<SampleBox>& within = {});

// Returns all samples of `labels` as if they had one label. Throws InputError, with the volume's
// `name` and the labels that there are, for a label without a sample. pre: labels is not empty.
LabelSamples united_labels(std::span<const LabelSamples> found,
                           std::span<const std::int64_t> labels, std::string_view name);

// Returns the indicator of `labels` in a box, as uint8. Its frame is moved along. pre: the volume
// is no block, and holds the box.
Volume label_indicator(const Segmentation& samples, std::span<const std::int64_t> labels,
                       const SampleBox& box, int threads = 1);

}  // namespace deliso
