// SPDX-License-Identifier: MIT
// How a volume's samples are distributed.
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

// Of the samples in `range`: at most `bins` equal bins, of an integer type each of equally many
// values.
Histogram make_histogram(const Volume& volume, const ValueRange& range, int bins);

// The value between two bins that parts the samples into the two most distinct classes: the
// variance between the classes is largest (Otsu 1979). In the middle of the range for one bin.
double otsu_threshold(const Histogram& histogram);

bool is_integer(SampleType type);

// One line per row of bins: its first value, a bar on a logarithmic scale, the share of samples.
std::string histogram_text(const Histogram& histogram, int rows);

}  // namespace deliso
