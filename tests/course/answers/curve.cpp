// SPDX-License-Identifier: MIT
// An answer to exercise 1 of the course.
#include "course/curve.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace deliso::course {

std::vector<Piece> curve_of(const Picture& g) {
  std::vector<Piece> curve;
  for (int j = 0; j + 1 < g.rows; ++j) {
    for (int i = 0; i + 1 < g.columns; ++i) {
      using Place = std::array<int, 2>;
      const std::array<Place, 4> at = {Place{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
      std::array<double, 4> v{};
      for (std::size_t m = 0; m < 4; ++m) v[m] = g.at(at[m][0], at[m][1]);
      std::vector<Point> x;  // around the square, beginning with side 0 1
      for (std::size_t m = 0; m < 4; ++m) {
        std::size_t a = m, b = (m + 1) % 4;
        if ((v[a] >= 0) == (v[b] >= 0)) continue;
        if (at[a][0] + at[a][1] > at[b][0] + at[b][1]) std::swap(a, b);
        const double t = v[a] / (v[a] - v[b]);
        x.push_back({at[a][0] + t * (at[b][0] - at[a][0]), at[a][1] + t * (at[b][1] - at[a][1])});
      }
      if (x.size() == 2) curve.push_back({x[0], x[1]});
      if (x.size() != 4) continue;
      const double saddle = (v[0] * v[2] - v[1] * v[3]) / (v[0] + v[2] - v[1] - v[3]);
      // Corner 0 is cut off by the points on the sides 3 0 and 0 1.
      const bool cuts_off_0 = (saddle >= 0) != (v[0] >= 0);
      curve.push_back(cuts_off_0 ? Piece{x[3], x[0]} : Piece{x[0], x[1]});
      curve.push_back(cuts_off_0 ? Piece{x[1], x[2]} : Piece{x[2], x[3]});
    }
  }
  return curve;
}

RestrictedVoronoi restricted_voronoi(std::span<const Piece> curve, std::span<const Point> sites) {
  RestrictedVoronoi out;
  for (const auto& [a, b] : curve) {
    const Point d{b.x - a.x, b.y - a.y};
    const auto distance2_at_a = [&](std::size_t s) {
      return (a.x - sites[s].x) * (a.x - sites[s].x) + (a.y - sites[s].y) * (a.y - sites[s].y);
    };
    std::size_t site = 0;
    for (std::size_t s = 1; s < sites.size(); ++s) {
      if (distance2_at_a(s) < distance2_at_a(site)) site = s;
    }
    Point from = a;
    while (true) {
      // |p - s|^2 - |p - site|^2 = lead - t * speed.
      double first = 1;
      std::optional<std::size_t> next;
      for (std::size_t s = 0; s < sites.size(); ++s) {
        const double speed =
            2 * ((sites[s].x - sites[site].x) * d.x + (sites[s].y - sites[site].y) * d.y);
        if (speed <= 0) continue;
        const double t = (distance2_at_a(s) - distance2_at_a(site)) / speed;
        if (t >= first) continue;
        first = t;
        next = s;
      }
      const Point to = next ? Point{a.x + first * d.x, a.y + first * d.y} : b;
      out.parts.push_back({from, to, static_cast<int>(site)});
      if (!next) break;
      const auto [low, high] = std::minmax(site, *next);
      out.crossings.push_back({to, static_cast<int>(low), static_cast<int>(high)});
      site = *next;
      from = to;
    }
  }
  return out;
}

}  // namespace deliso::course
