// SPDX-License-Identifier: MIT
// A median filter of the samples: it removes single outliers, and keeps edges where they are.
#pragma once

#include "volume/volume.h"

namespace deliso {

inline constexpr int kLargestMedianRadius = 3;  // samples

// Returns the volume whose samples are the medians of the boxes of (2 `radius` + 1)^3 samples
// around them, of the same type. Beyond the box samples are reflected (d c b a | a b c d | d c b
// a); beyond a block's too, so what lies within the radius of an inner face differs from the larger
// volume's. The result is the same with any number of threads.
//
// A histogram slides along each row (Huang, Yang and Tang 1979): a step costs 2 (2 radius + 1)^2
// updates, whatever the type. Its bins are values of 8 and 16 bits, and else the ranks of the
// samples in a tile. Memory: the result, and a histogram with a tile per thread.
// pre: radius is from 1 to kLargestMedianRadius; no sample is NaN.
Volume median(const Volume& volume, int radius, int threads = 1);

}  // namespace deliso
