// SPDX-License-Identifier: MIT
// Finds isovalues that separate the samples of a volume: the valleys between the modes of their
// histogram.
//
//   M1  Padding is no mode. It is one of the three outermost values at the low or high end, and a
//       hundredth of all samples or more have exactly this value. The gap to the values inside is
//       wider than any gap between those, and wider than a 32nd of their range. (That range omits
//       the outermost thousandths.) Values outside of padding are padding too.
//   M2  The histogram has at most 4096 bins over the range of the other samples. A ten-thousandth
//       at either end are outliers, and are omitted. A Gaussian smooths it. Its width is the best
//       for a normal distribution (Silverman 1986, eq. 3.31) with the same shortest interval that
//       has an eighth of the samples. It is at least 2 occupied bins, since scaled integers leave
//       combs. Kernels of 2, 4 and 8 times the width add valleys between broad, low modes.
//   M3  Persistence distinguishes modes from bumps (Edelsbrunner, Letscher and Zomorodian 2002).
//       The valley must be lower than the lower mode by a third of that, and by 6 standard
//       deviations of the number of samples under the kernel. Neighboring samples are similar, so
//       eight count as one.
//   M4  A valley's isovalue is in the middle of its floor. The floor is less high above the lowest
//       bin than a valley must be deep.
//   M5  A material of few samples has no mode, such as bone in a CT. Then Otsu's threshold (1979)
//   of
//       the samples above the last valley is tried too. It must lie beyond the last mode by two of
//       the mode's half widths, with a thousandth of the samples above it.
// If there is only one mode, Otsu's threshold of all samples replaces the valleys.
#pragma once

#include <cstddef>
#include <vector>

#include "volume/volume.h"

namespace deliso {

struct Padding {
  double value = 0;
  double share = 0;  // of all samples
};

struct Valley {
  double isovalue = 0;  // between two values of an integer type, so that no sample equals it
  double below = 0, above = 0;            // shares of the samples without padding
  double mode_below = 0, mode_above = 0;  // the values of the two modes
  bool in_tail = false;                   // M5: there is no mode above
  double score = 0;  // depth in multiples of the least of M3, times the smaller share
};

struct Modes {
  std::vector<Padding> padding;  // the low ones, then the high ones, from outside in
  std::vector<Valley> valleys;   // best first
  bool by_otsu = false;          // there is one mode, and valleys has Otsu's threshold, if any
};

// Returns the modes, with at most `most` valleys. There are none if all samples but padding have
// one value, or their range is no double. Cost: a few passes over the samples. pre: `range` is the
// volume's.
Modes find_modes(const Volume& volume, const ValueRange& range, std::size_t most);

}  // namespace deliso
