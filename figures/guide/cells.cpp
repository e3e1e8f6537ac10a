// SPDX-License-Identifier: MIT
// Voronoi cells with the piece of a surface in each, as the page of the lesson has them to be
// turned.
#include "lesson/cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "guide/drawing.h"
#include "guide/figures.h"

namespace deliso::guide {
namespace {

// How the page shows them at first.
constexpr double kYaw = 0.5, kPitch = 0.5;

// x to the right, y up, z towards the eye.
Vec3 turned(const Vec3& p) {
  const double across = std::cos(kYaw) * p.x - std::sin(kYaw) * p.y,
               deep = std::sin(kYaw) * p.x + std::cos(kYaw) * p.y;
  return {across, std::cos(kPitch) * p.z + std::sin(kPitch) * deep,
          std::sin(kPitch) * p.z - std::cos(kPitch) * deep};
}

struct Seen {
  std::vector<Vec2> points;
  double depth = 0;
  Style front, back;
};

Seen seen(const Panel& panel, const lesson::Polygon& polygon, double lift, const Style& front,
          const Style& back) {
  Seen out{{}, lift, front, back};
  for (const Vec3& p : polygon) {
    const Vec3 q = turned(p);
    out.points.push_back(panel.at({q.x, q.y}));
    out.depth += q.z / static_cast<double>(polygon.size());
  }
  return out;
}

// On paper y is down, so what is counter-clockwise to the eye has a negative area.
bool is_front(const std::vector<Vec2>& points) {
  double area = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec2 &p = points[n], &q = points[(n + 1) % points.size()];
    area += p.x * q.y - p.y * q.x;
  }
  return area < 0;
}

void draw(Drawing& out, const Panel& panel, const lesson::Cell& cell) {
  const Style side{.stroke = ink::kBlue, .width = 1, .fill = "none"},
      outside{.stroke = ink::kOrange, .width = 0.5, .fill = ink::kOrange},
      inside{.stroke = ink::kAbove, .width = 0.5, .fill = ink::kAbove},
      end{.stroke = ink::kSigma, .width = 1.5};
  std::vector<Seen> all;
  for (const auto& p : cell.sides) all.push_back(seen(panel, p, 0, side, side));
  for (const auto& p : cell.surface) all.push_back(seen(panel, p, 0, outside, inside));
  for (const auto& p : cell.ends) all.push_back(seen(panel, p, 0.01, end, end));
  std::stable_sort(all.begin(), all.end(),
                   [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
  for (const Seen& s : all) out.polygon(s.points, is_front(s.points) ? s.front : s.back);
}

}  // namespace

void draw_cells(const std::string& folder) {
  Drawing out(1145, 310);
  double x = 10;
  for (const lesson::Cell& cell : lesson::example_cells()) {
    const Panel panel{{-1.1, -1.1}, 270 / 2.2, {x, 35}, {270, 270}};
    out.text({x + 135, 22}, std::string(cell.title) + ", " + cell.text, Anchor::middle, 14);
    draw(out, panel, cell);
    x += 285;
  }
  out.write(folder, "cells");
}

}  // namespace deliso::guide
