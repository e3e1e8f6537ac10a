// SPDX-License-Identifier: MIT
#include "view/gray/gray.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace deliso {

double GrayWindow::gray(double value) const {
  // Halves, as the range may be too wide for a double.
  const double width = 0.5 * hi - 0.5 * lo;
  return width > 0 ? std::clamp((0.5 * value - 0.5 * lo) / width, 0.0, 1.0) : 0.5;
}

GrayWindow gray_window(const Volume& volume, const ValueRange& range) {
  constexpr std::size_t kCounted = std::size_t{1} << 20;
  constexpr double kOutliers = 0.005;  // share of the samples, at either end
  // Odd, so that it goes through all columns of a volume whose size is a power of two.
  const std::size_t stride = volume.sample_count() / kCounted | 1;
  std::vector<double> values;
  volume.visit([&](const auto* samples) {
    for (std::size_t n = 0; n < volume.sample_count(); n += stride) {
      const auto value = static_cast<double>(samples[n]);
      if (range.min < value && value < range.max) values.push_back(value);
    }
  });
  if (values.empty()) return {range.min, range.max};
  const auto at = [&](double share) {
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const GrayWindow window{at(kOutliers), at(1 - kOutliers)};
  return window.lo < window.hi ? window : GrayWindow{range.min, range.max};
}

std::function<std::optional<double>(const Vec3&)> gray_inside(const Volume& volume, double kappa,
                                                              const GrayWindow& window) {
  return [volume, kappa, window, box = volume.box()](const Vec3& place) -> std::optional<double> {
    const Vec3 p = volume.frame().from_world(place);
    if (!box.contains(p)) return std::nullopt;
    const double value = volume.value(p);
    return value < kappa ? std::nullopt : std::optional(window.gray(value));
  };
}

}  // namespace deliso
