// SPDX-License-Identifier: MIT
// How a volume's samples are distributed, and a first isovalue to try.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "volume/volume.h"

namespace deliso {

// counts[b] samples lie in [min + b * width, min + (b + 1) * width), the last bin closed.
struct Histogram {
  ValueRange range;
  double width = 0;
  std::vector<std::uint64_t> counts;
};

// `bins` equal bins over `range`, or one bin per value where an integer type has fewer values.
Histogram make_histogram(const Volume& volume, const ValueRange& range, int bins);

// The value between two bins that parts the samples into the two most distinct classes: the
// variance between the classes is largest (Otsu 1979). In the middle of the range for one bin.
double otsu_threshold(const Histogram& histogram);

// An isovalue near `threshold`: for an integer type between two values, where no plateau of equal
// samples lies, and not halfway, where the surface would pass through the middles of grid edges.
double suggested_isovalue(SampleType type, double threshold);

// One line per row of bins: its first value, a bar on a logarithmic scale, the share of samples.
std::string histogram_text(const Histogram& histogram, int rows);

}  // namespace deliso
