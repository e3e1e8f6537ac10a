// SPDX-License-Identifier: MIT
// The distribution of a volume's samples.
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

// Returns the histogram of the samples in `range`, with at most `bins` equal bins. For an integer
// type each bin has the same number of values.
Histogram make_histogram(const Volume& volume, const ValueRange& range, int bins);

// Returns the same without outliers, if a tenth of the bins have no other samples: they are a
// ten-thousandth of the samples at either end.
Histogram bulk_histogram(const Volume& volume, ValueRange range, int bins);

// Returns one line per row of bins: first value, bar on a logarithmic scale, share of samples.
std::string histogram_text(const Histogram& histogram, int rows);

}  // namespace deliso
