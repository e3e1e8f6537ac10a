// SPDX-License-Identifier: MIT
// Repeated measurements in two numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace deliso {

struct Statistic {
  double median = 0;
  double spread = 0;  // (largest - smallest) / median; 0 for one value
  std::size_t count = 0;
  double smallest = 0, largest = 0;
};

inline Statistic statistic(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  return {median, median > 0 ? (values.back() - values.front()) / median : 0, n, values.front(),
          values.back()};
}

}  // namespace deliso
