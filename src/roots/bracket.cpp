// SPDX-License-Identifier: MIT
#include "roots/bracket.h"

namespace deliso {

double bracketed_root(const Cubic& c, double lo, double hi, bool rising, Accuracy accuracy) {
  double last_step = hi - lo, t = lo + 0.5 * (hi - lo);
  while (true) {
    const double f = value_at(c, t), slope = slope_at(c, t);
    if (std::abs(f) <= accuracy.noise && (slope > 0) == rising) return t;
    ((f >= 0) == rising ? hi : lo) = t;
    double next = t - f / slope;
    const bool newton = lo < next && next < hi && std::abs(next - t) <= 0.5 * last_step;
    if (!newton) next = lo + 0.5 * (hi - lo);
    const double step = std::abs(next - t);
    t = next;
    if (step <= (newton ? accuracy.last_step : 0x1p-53)) return t;
    last_step = newton ? step : hi - lo;
  }
}

}  // namespace deliso
