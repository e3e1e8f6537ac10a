// SPDX-License-Identifier: MIT
// Labels: a segmentation gives every sample the whole number of its material. The indicator of some
// labels is 1 at their samples and 0 elsewhere; smoothed, it has a surface around them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "volume/volume.h"

namespace deliso {

// One label's samples.
struct LabelSamples {
  std::int64_t label = 0;
  std::uint64_t samples = 0;
  // In voxels, within the domain box: a sample on a face of the box has half a voxel there, on an
  // edge a quarter.
  double volume = 0;
  Index3 first, last;  // of the smallest box around them
};

// Returns all labels of the volume, in their order. Throws InputError, with the volume's `name`,
// for the first sample that is no whole number of at most 2^53. The result is the same with any
// number of threads.
std::vector<LabelSamples> find_labels(const Volume& volume, std::string_view name, int threads = 1);

// Returns all samples of `labels` as if they had one label. Throws InputError, with the volume's
// `name` and the labels that there are, for a label without a sample. pre: labels is not empty.
LabelSamples united_labels(std::span<const LabelSamples> found,
                           std::span<const std::int64_t> labels, std::string_view name);

// Returns the indicator of `labels`, as uint8, of the box around `extent` with a margin of samples
// on each side, as far as there are any. Its frame is moved along. pre: `volume` is no block.
Volume label_indicator(const Volume& volume, std::span<const std::int64_t> labels,
                       const LabelSamples& extent, Index3 margin, int threads = 1);

// The volume of {g >= level}, in voxels within the box, at one half and at the level where it is
// `target`. It is found from 64 points of each voxel. If nothing is above 0, the level is one
// half. pre: samples are from 0 to 1.
struct IndicatorLevel {
  double at_half = 0;  // volume
  double level = 0;    // whose volume is the target
};
IndicatorLevel find_level(const Volume& indicator, double target, int threads = 1);

}  // namespace deliso
