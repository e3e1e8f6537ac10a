// SPDX-License-Identifier: MIT
// The box's continuation by reflection, of all filters.
#pragma once

namespace deliso {

// Returns the sample that stands at index i, of any sign, of a row of n: d c b a | a b c d | d c b
// a.
inline int reflected(int i, int n) {
  const int in_period = ((i % (2 * n)) + 2 * n) % (2 * n);
  return in_period < n ? in_period : 2 * n - 1 - in_period;
}

}  // namespace deliso
