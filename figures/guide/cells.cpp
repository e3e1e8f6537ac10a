// SPDX-License-Identifier: MIT
// Voronoi cells with the piece of a surface in each, as the page of the lesson has them to be
// turned.
#include "lesson/cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "guide/drawing.h"
#include "guide/figures.h"
#include "io/files/append_format.h"

namespace deliso::guide {
namespace {

// How the page shows them at first.
constexpr double kYaw = 0.5, kPitch = 0.5;

struct Seen {
  std::vector<Vec2> points;
  double depth = 0;
  Style front, back;
};

Seen seen(const Panel& panel, const lesson::Polygon& polygon, double lift, const Style& front,
          const Style& back) {
  Seen out{{}, lift, front, back};
  for (const Vec3& p : polygon) {
    const Vec3 q = turned(p, kYaw, kPitch);
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

// A polygon's brightness, from its normal: light falls from the upper left, behind the eye.
double light_on(const lesson::Polygon& polygon) {
  Vec3 normal;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
    normal = normal + cross(turned(p, kYaw, kPitch), turned(q, kYaw, kPitch));
  }
  const Vec3 from{-0.5, 0.6, 0.62};
  return std::max(0.0, dot(normal, from) / std::sqrt(dot(normal, normal)));
}

// Orange outside, gray within.
std::string shade(bool is_front, double light) {
  const Vec3 dark = is_front ? Vec3{140, 74, 20} : Vec3{96, 104, 118},
             bright = is_front ? Vec3{250, 190, 120} : Vec3{214, 220, 229};
  const Vec3 color = dark + light * (bright - dark);
  std::string out;
  append_format(out, "#%02x%02x%02x", static_cast<int>(color.x), static_cast<int>(color.y),
                static_cast<int>(color.z));
  return out;
}

}  // namespace

// The pieces of a torus, pulled apart: each lies in the cell of its site.
void draw_torus(const std::string& folder) {
  constexpr double kApart = 0.3;  // how far a piece goes, as a share of its way from the middle
  std::vector<lesson::Cell> cells = lesson::torus_cells();
  const auto middle_of = [](const std::vector<lesson::Polygon>& polygons) {
    Vec3 sum;
    double corners = 0;
    for (const auto& polygon : polygons) {
      for (const Vec3& p : polygon) sum = sum + p;
      corners += static_cast<double>(polygon.size());
    }
    return sum / corners;
  };
  std::vector<lesson::Polygon> whole;
  for (const auto& cell : cells) {
    whole.insert(whole.end(), cell.surface.begin(), cell.surface.end());
  }
  const Vec3 center = middle_of(whole);
  double radius = 0;
  for (auto& cell : cells) {
    const Vec3 shift = kApart * (middle_of(cell.surface) - center) - center;
    for (auto* list : {&cell.surface, &cell.ends}) {
      for (auto& polygon : *list) {
        for (Vec3& p : polygon) {
          p = p + shift;
          radius = std::max(radius, std::sqrt(dot(p, p)));
        }
      }
    }
  }
  Drawing out(832, 440, nullptr);
  const double scale = 345 / radius;
  const Panel panel{{-416 / scale, -220 / scale}, scale, {0, 0}, {832, 440}};
  struct Piece {
    Seen seen;
    std::string color;  // none: a line
  };
  std::vector<Piece> pieces;
  for (const auto& cell : cells) {
    for (const auto& p : cell.surface) {
      Seen s = seen(panel, p, 0, {}, {});
      const bool is_front = deliso::guide::is_front(s.points);
      const double light = light_on(p);
      pieces.push_back(
          {std::move(s), shade(is_front, is_front ? light : light_on({p.rbegin(), p.rend()}))});
    }
    for (const auto& p : cell.ends) pieces.push_back({seen(panel, p, 0.02 * radius, {}, {}), ""});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.seen.depth < b.seen.depth; });
  for (const auto& [s, color] : pieces) {
    if (color.empty())
      out.polyline(s.points, {.stroke = ink::kSigma, .width = 1.1});
    else
      out.polygon(s.points, {.stroke = color.c_str(), .width = 0.5, .fill = color.c_str()});
  }
  out.write(folder, "torus");
}

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
