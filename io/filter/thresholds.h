// SPDX-License-Identifier: MIT
// Finds isovalues that separate the materials of a volume, by its samples' histogram.
//
// The bins are divided into three classes with the largest variance between them (Otsu 1979). A bin
// weighs the square root of its count, so that a material of few samples is a class too, such as
// bone in a CT. The threshold between two classes is proposed if the histogram is at most half as
// high there as somewhere in the two; else it would divide the noise of one material. If none is
// proposed, the best threshold of two classes is.
//
// Padding is left out. It is a value at the low or high end of the range that a hundredth of all
// samples or more have, and the gap to the others is wider than a 32nd of their range. Outliers are
// left out too: a ten-thousandth of the samples at either end, if they are far away.
#pragma once

#include <cstddef>
#include <vector>

#include "volume/volume.h"

namespace deliso {

struct Padding {
  double value = 0;
  double share = 0;  // of all samples
};

struct Threshold {
  double isovalue = 0;  // between two values of an integer type, so that no sample equals it
  double below = 0;     // share of the samples without padding and far outliers
  double mean_below = 0, mean_above = 0;  // of the two classes beside it
};

struct Thresholds {
  std::vector<Padding> padding;   // the low ones, then the high ones, from outside in
  std::vector<Threshold> levels;  // the lower first
};

// Returns one or two thresholds. There are none if all samples but padding have one value, or
// their range is no double. Cost: a few passes over the samples. pre: `range` is the volume's.
Thresholds find_thresholds(const Volume& volume, const ValueRange& range);

}  // namespace deliso
