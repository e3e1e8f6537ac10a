// SPDX-License-Identifier: MIT
// Which isovalues part the samples of a volume: the valleys between the modes of their histogram.
//
//   M1  Padding is no mode. The first, second or third value from the low or high end counts as
//       padding when a hundredth of all samples or more have it exactly, and the gap to the values
//       further in is wider than a 32nd of the range of the rest (its outermost thousandths left
//       out) and than any gap in there. So does what lies beyond it.
//   M2  The histogram is fine, at most 4096 bins, over the range of the rest without outliers: a
//       ten-thousandth at either end. It is smoothed by a Gaussian: as wide as is best for a normal
//       distribution (Silverman 1986, eq. 3.31) that is as narrow as the shortest interval with an
//       eighth of the samples, but 2 occupied bins at least, since scaled integers leave combs.
//       Kernels twice, four and eight times as wide add valleys between modes that are too broad
//       and low to be told by the narrow one.
//   M3  Modes are told from bumps by persistence (Edelsbrunner, Letscher and Zomorodian 2002): the
//       valley between two is lower than the lower one by a third of that and by 6 standard
//       deviations of the number of samples under the kernel; neighbors in a volume being alike,
//       eight samples count as one.
//   M4  A valley's isovalue is in the middle of its floor: of what rises above its lowest place by
//       less than would make a valley.
// Where all is one mode, Otsu's threshold (1979) takes the place of valleys.
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
  double below = 0, above = 0;            // shares of the samples that are no padding
  double mode_below = 0, mode_above = 0;  // the values of the modes it parts
  double score = 0;  // its depth in multiples of what M3 asks for, times the smaller of the shares
};

struct Modes {
  std::vector<Padding> padding;  // the low ones, then the high ones, from outside in
  std::vector<Valley> valleys;   // best first
  bool by_otsu = false;          // there is one mode, and valleys has Otsu's threshold, if any
};

// At most `most` valleys. Looks at all samples a few times. No valleys where all that is no padding
// is one value, or its range is no double. pre: `range` is the volume's.
Modes find_modes(const Volume& volume, const ValueRange& range, std::size_t most);

}  // namespace deliso
