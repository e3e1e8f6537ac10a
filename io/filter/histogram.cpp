// SPDX-License-Identifier: MIT
#include "io/filter/histogram.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <type_traits>

#include "io/files/append_format.h"

namespace deliso {

Histogram make_histogram(const Volume& volume, const ValueRange& range, int bins) {
  const double span = range.max - range.min;
  Histogram histogram;
  histogram.range = range;
  if (is_integer(volume.type())) {
    histogram.width = std::ceil((span + 1) / bins);
    bins = static_cast<int>(std::ceil((span + 1) / histogram.width));
  } else {
    histogram.width = span / bins;
  }
  histogram.counts.assign(static_cast<std::size_t>(bins), 0);

  const double per_value = histogram.width > 0 ? 1 / histogram.width : 0;
  const double last = bins - 1;
  const std::size_t count = volume.sample_count();
  volume.visit([&](const auto* samples) {
    for (std::size_t n = 0; n < count; ++n) {
      const auto sample = static_cast<double>(samples[n]);
      if (sample < range.min || sample > range.max) continue;
      const double bin = (sample - range.min) * per_value;
      // Clamped: the range may be too wide for a double, or a single value.
      ++histogram.counts[bin > 0 ? static_cast<std::size_t>(std::min(bin, last)) : 0];
    }
  });
  return histogram;
}

Histogram bulk_histogram(const Volume& volume, ValueRange range, int bins) {
  constexpr double kOutlierShare = 1e-4;  // at either end
  for (;;) {
    Histogram h = make_histogram(volume, range, bins);
    const double rest = kOutlierShare * std::accumulate(h.counts.begin(), h.counts.end(), 0.0);
    const auto bulk_from = [&](auto bin, auto end) {
      for (double sum = 0; bin + 1 != end; ++bin) {
        if ((sum += static_cast<double>(*bin)) > rest) break;
      }
      return bin;
    };
    const auto first = bulk_from(h.counts.begin(), h.counts.end());
    const auto end = bulk_from(h.counts.rbegin(), std::reverse_iterator(first)).base();
    if (10 * (end - first) >= 9 * std::ssize(h.counts) || !(h.width > 0)) return h;
    const double low = range.min + h.width * static_cast<double>(first - h.counts.begin());
    const double high = low + h.width * static_cast<double>(end - first);
    if (!(high - low < range.max - range.min)) return h;
    range = {low, std::min(range.max, high)};
  }
}

std::string histogram_text(const Histogram& histogram, int rows) {
  constexpr int kWidth = 40;
  const std::size_t bins = histogram.counts.size();
  const std::size_t per_row =
      (bins + static_cast<std::size_t>(rows) - 1) / static_cast<std::size_t>(rows);
  std::vector<std::uint64_t> sums;
  for (std::size_t b = 0; b < bins; b += per_row) {
    const auto first = histogram.counts.begin() + static_cast<std::ptrdiff_t>(b);
    const auto last =
        histogram.counts.begin() + static_cast<std::ptrdiff_t>(std::min(b + per_row, bins));
    sums.push_back(std::accumulate(first, last, std::uint64_t{0}));
  }
  const auto total = static_cast<double>(std::accumulate(sums.begin(), sums.end(), 0.0));
  const auto largest = static_cast<double>(*std::max_element(sums.begin(), sums.end()));

  std::string text;
  append_format(text, "%12s |%-*s %10s\n", "from", kWidth, "bars grow with the count's logarithm",
                "share");
  for (std::size_t row = 0; row < sums.size(); ++row) {
    const auto count = static_cast<double>(sums[row]);
    const double height = kWidth * std::log1p(count) / std::log1p(largest);
    const std::string bar(static_cast<std::size_t>(std::ceil(height)), '#');
    append_format(text, "%12.6g |%-*s %8.4f %%\n",
                  histogram.range.min + histogram.width * static_cast<double>(row * per_row),
                  kWidth, bar.c_str(), 100 * count / total);
  }
  return text;
}

}  // namespace deliso
