// SPDX-License-Identifier: MIT
// The samples of a volume as gray values.
#pragma once

#include <functional>
#include <optional>

#include "volume/volume.h"

namespace deliso {

// From black at `lo` to white at `hi`.
struct GrayWindow {
  double lo = 0, hi = 1;

  double gray(double value) const;  // from 0 to 1
};

// Returns the window of a volume without outliers: 99 % of its samples lie in it. The smallest and
// the largest value do not count, as padding and saturated samples have them. pre: `range` is the
// volume's.
GrayWindow gray_window(const Volume& volume, const ValueRange& range);

// Returns the gray of a place in the world, or nothing where it is outside of the surface or of the
// volume's box. Keeps the volume. `kappa`: geometric_isovalue().
std::function<std::optional<double>(const Vec3&)> gray_inside(const Volume& volume, double kappa,
                                                              const GrayWindow& window);

}  // namespace deliso
