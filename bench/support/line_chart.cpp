// SPDX-License-Identifier: MIT
#include "support/line_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "io/files/append_format.h"
#include "io/files/atomic_file.h"

namespace deliso {
namespace {

constexpr double kWidth = 760, kHeight = 440;
constexpr double kLeft = 78, kRight = 178, kTop = 46, kBottom = 56;  // margins; the legend is right

// Okabe and Ito 2008: told apart by color-blind readers too.
constexpr std::array<const char*, LineChart::kMostSeries> kColors{
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c8c00"};

// Where a value lies on the paper.
class Scale {
 public:
  Scale(const Axis& axis, double lo, double hi, double from, double to)
      : logarithmic_(axis.logarithmic), lo_(at(lo)), hi_(at(hi)), from_(from), to_(to) {}
  double operator()(double value) const {
    return from_ + (to_ - from_) * (at(value) - lo_) / (hi_ - lo_);
  }

 private:
  double at(double value) const { return logarithmic_ ? std::log10(value) : value; }

  bool logarithmic_;
  double lo_, hi_, from_, to_;
};

struct Extent {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
};

// The values shown, with a little room; a linear axis begins at 0 where nothing is below.
Extent extent_of(const std::vector<Series>& series, const Axis& axis, bool of_x) {
  Extent e;
  for (const Series& s : series) {
    for (const auto& [x, y] : s.points) {
      const double value = of_x ? x : y;
      if (!std::isfinite(value) || (axis.logarithmic && !(value > 0))) continue;
      e.lo = std::min(e.lo, value);
      e.hi = std::max(e.hi, value);
    }
  }
  if (!(e.lo <= e.hi)) return {1, 10};
  if (axis.logarithmic) {
    e.lo /= 1.15;
    e.hi *= 1.15;
  } else {
    e.lo = std::min(e.lo, 0.);
    e.hi += e.hi == e.lo ? 1 : 0.04 * (e.hi - e.lo);
  }
  return e;
}

std::string round_label(double value) {
  std::string label;
  const double size = std::fabs(value);
  if (size >= 1e6) {
    append_format(label, "%gM", value / 1e6);
  } else if (size >= 1e4) {
    append_format(label, "%gk", value / 1e3);
  } else {
    append_format(label, "%g", value);
  }
  return label;
}

// Where an axis that shows `e` has ticks, and what is written there.
std::vector<std::pair<double, std::string>> ticks_of(const Axis& axis, const Extent& e) {
  std::vector<std::pair<double, std::string>> ticks;
  for (const auto& tick : axis.ticks) {
    if (tick.first >= e.lo && tick.first <= e.hi) ticks.push_back(tick);
  }
  if (!axis.ticks.empty()) return ticks;
  for (const double at : axis_ticks(e.lo, e.hi, axis.logarithmic)) {
    ticks.emplace_back(at, round_label(at));
  }
  return ticks;
}

}  // namespace

std::string svg_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

std::vector<double> axis_ticks(double lo, double hi, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    const bool few = std::log10(hi / lo) < 2.5;  // then 2 and 5 are shown too
    for (int e = static_cast<int>(std::floor(std::log10(lo))); std::pow(10., e) <= hi; ++e) {
      for (const double digit : {1., 2., 5.}) {
        const double tick = digit * std::pow(10., e);
        if (tick >= lo && tick <= hi && (digit == 1 || few)) ticks.push_back(tick);
      }
    }
    return ticks;
  }
  const double rough = (hi - lo) / 6, power = std::pow(10., std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double digit : {5., 2., 1.}) {
    if (digit * power >= rough) step = digit * power;
  }
  for (double n = std::ceil(lo / step); n * step <= hi; ++n) ticks.push_back(n * step);
  return ticks;
}

std::string LineChart::svg() const {
  DELISO_CHECK(series.size() <= kColors.size());
  const Extent ex = extent_of(series, x, true), ey = extent_of(series, y, false);
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  const Scale to_x(x, ex.lo, ex.hi, kLeft, right), to_y(y, ey.lo, ey.hi, bottom, kTop);

  std::string out;
  append_format(
      out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g "
      "%g\" font-family=\"sans-serif\" font-size=\"13\">\n",
      kWidth, kHeight, kWidth, kHeight);
  append_format(out, "<rect width=\"%g\" height=\"%g\" fill=\"#ffffff\"/>\n", kWidth, kHeight);
  append_format(out, "<text x=\"%g\" y=\"26\" font-size=\"15\" font-weight=\"bold\">%s</text>\n",
                kLeft, svg_escaped(title).c_str());
  for (const auto& [value, label] : ticks_of(x, ex)) {
    const double at = to_x(value);
    append_format(out, "<path d=\"M%.2f %.2fV%.2f\" stroke=\"#dddddd\"/>\n", at, bottom, kTop);
    append_format(out, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"middle\">%s</text>\n", at,
                  bottom + 19, svg_escaped(label).c_str());
  }
  for (const auto& [value, label] : ticks_of(y, ey)) {
    const double at = to_y(value);
    append_format(out, "<path d=\"M%.2f %.2fH%.2f\" stroke=\"#dddddd\"/>\n", kLeft, at, right);
    append_format(out, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"end\">%s</text>\n", kLeft - 8,
                  at + 4.5, svg_escaped(label).c_str());
  }
  append_format(out, "<path d=\"M%.2f %.2fV%.2fH%.2f\" fill=\"none\" stroke=\"#333333\"/>\n", kLeft,
                kTop, bottom, right);
  append_format(out, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"middle\">%s</text>\n",
                0.5 * (kLeft + right), kHeight - 14, svg_escaped(x.label).c_str());
  append_format(
      out, "<text transform=\"translate(20 %.2f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
      0.5 * (kTop + bottom), svg_escaped(y.label).c_str());

  for (std::size_t n = 0; n < series.size(); ++n) {
    std::string line, dots;
    for (const auto& [px, py] : series[n].points) {
      if (!std::isfinite(px) || !std::isfinite(py)) continue;
      if ((x.logarithmic && !(px > 0)) || (y.logarithmic && !(py > 0))) continue;
      append_format(line, "%s%.2f %.2f", line.empty() ? "M" : "L", to_x(px), to_y(py));
      if (markers) {
        append_format(dots, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3.2\" fill=\"%s\"/>\n", to_x(px),
                      to_y(py), kColors[n]);
      }
    }
    if (line.empty()) continue;
    out.append("<path d=\"").append(line);
    append_format(out, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"/>\n", kColors[n]);
    out.append(dots);
    const double at = kTop + 12 + 22 * static_cast<double>(n);
    append_format(out, "<path d=\"M%.2f %.2fh22\" stroke=\"%s\" stroke-width=\"3\"/>\n", right + 14,
                  at, kColors[n]);
    append_format(out, "<text x=\"%.2f\" y=\"%.2f\">%s</text>\n", right + 42, at + 4.5,
                  svg_escaped(series[n].name).c_str());
  }
  return out + "</svg>\n";
}

void write_chart(const LineChart& chart, const std::string& folder, const std::string& name) {
  if (folder.empty()) return;
  AtomicFile file(folder + "/" + name + ".svg");
  file.write(chart.svg());
  file.commit();
}

}  // namespace deliso
