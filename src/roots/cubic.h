// SPDX-License-Identifier: MIT
// Real roots of a cubic in an interval: what a voxel-ray intersection comes down to (paper §4.2).
// Two ways behind one interface: Schwarze 1990 (the paper's), and interval isolation after Marmitt
// et al. 2004.
#pragma once

#include <array>
#include <span>

namespace deliso {

enum class CubicMethod { schwarze, isolation };

struct Roots {
  std::array<double, 3> t{};
  int count = 0;
  std::span<const double> span() const { return {t.data(), static_cast<std::size_t>(count)}; }
};

// Real roots of c[0] + c[1] t + c[2] t^2 + c[3] t^3 in [lo, hi], increasing.
Roots solve_cubic(const std::array<double, 4>& c, double lo, double hi, CubicMethod method);

}  // namespace deliso
