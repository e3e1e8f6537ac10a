// SPDX-License-Identifier: MIT
// A line chart as SVG 1.1: axes with ticks (linear or logarithmic), a legend, one polyline with
// markers per series. Plain shapes and text, nothing to load, the same bytes for the same numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace deliso {

struct Axis {
  std::string label;
  bool logarithmic = false;                             // then only positive values are drawn
  std::vector<std::pair<double, std::string>> ticks{};  // those shown; none: round numbers
};

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  // joined in this order
};

struct LineChart {
  static constexpr std::size_t kMostSeries = 8;  // as many colors

  std::string title;
  Axis x, y;
  std::vector<Series> series;
  bool markers = true;

  std::string svg() const;
};

// Text as it stands in SVG.
std::string svg_escaped(std::string_view text);

// The ticks of an axis that shows lo to hi: round numbers, in ascending order, within it.
std::vector<double> axis_ticks(double lo, double hi, bool logarithmic);

// Writes the chart to FOLDER/NAME.svg; does nothing where `folder` is empty.
void write_chart(const LineChart& chart, const std::string& folder, const std::string& name);

}  // namespace deliso
