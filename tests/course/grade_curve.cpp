// SPDX-License-Identifier: MIT
// The first exercise of the course: curves whose shape is known, and every site looked at for every
// part of them.
#include "course/curve.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/random.h"

using namespace deliso;
using namespace deliso::course;

namespace {

template <class F>
Picture sampled_picture(int columns, int rows, F&& f) {
  Picture g{columns, rows, {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) g.samples.push_back(f(1.0 * i, 1.0 * j));
  }
  return g;
}

double in_circle(double x, double y, double cx, double cy, double r) {
  return r - std::hypot(x - cx, y - cy);
}
Picture circle() {
  return sampled_picture(20, 18, [](double x, double y) { return in_circle(x, y, 9.3, 8.2, 6.1); });
}
Picture two_circles() {
  return sampled_picture(30, 16, [](double x, double y) {
    return std::max(in_circle(x, y, 7.3, 8.2, 5.1), in_circle(x, y, 22.1, 7.7, 4.3));
  });
}
// Cassini's ovals: one curve above 1, two below it. At 1 it is a figure of eight.
Picture ovals(double level) {
  return sampled_picture(50, 30, [&](double x, double y) {
    const double u = (x - 24.6) / 14, v = (y - 14.3) / 14;
    return level - std::hypot(u - 1, v) * std::hypot(u + 1, v);
  });
}
Picture noise(std::uint64_t seed) {
  Random random(seed);
  return sampled_picture(9, 8, [&](double, double) { return random.uniform(-1, 1); });
}

using Key = std::pair<double, double>;
Key key(const Point& p) {
  return {p.x, p.y};
}

// The ends of pieces at each point.
std::map<Key, int> ends_at(const std::vector<Piece>& curve) {
  std::map<Key, int> ends;
  for (const Piece& p : curve) ++ends[key(p.a)], ++ends[key(p.b)];
  return ends;
}

// How many curves the pieces make up.
std::size_t count_curves(const std::vector<Piece>& curve) {
  std::map<Key, Key> parent;
  const auto root = [&](Key k) {
    while (parent.try_emplace(k, k).first->second != k) k = parent[k];
    return k;
  };
  for (const Piece& p : curve) parent[root(key(p.a))] = root(key(p.b));
  return static_cast<std::size_t>(
      std::ranges::count_if(parent, [](const auto& e) { return e.first == e.second; }));
}

double distance(const Point& p, const Point& q) {
  return std::hypot(p.x - q.x, p.y - q.y);
}
Point between(const Point& a, const Point& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

double bilinear(const Picture& g, int i, int j, double u, double v) {
  return (1 - v) * ((1 - u) * g.at(i, j) + u * g.at(i + 1, j)) +
         v * ((1 - u) * g.at(i, j + 1) + u * g.at(i + 1, j + 1));
}

// True if the interpolant joins the corners (0, 0) and (1, 1) of the square: by a flood on a fine
// grid.
bool diagonal_joined(const Picture& g, int i, int j) {
  constexpr int kFine = 80;
  const bool side = g.at(i, j) >= 0;
  std::vector<std::uint8_t> reached((kFine + 1) * (kFine + 1), 0);
  std::vector<std::array<int, 2>> todo{{0, 0}};
  while (!todo.empty()) {
    const auto [a, b] = todo.back();
    todo.pop_back();
    if (a < 0 || b < 0 || a > kFine || b > kFine) continue;
    std::uint8_t& seen = reached[static_cast<std::size_t>(a + (kFine + 1) * b)];
    if (seen != 0 || (bilinear(g, i, j, 1.0 * a / kFine, 1.0 * b / kFine) >= 0) != side) continue;
    seen = 1;
    for (const auto& [da, db] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      todo.push_back({a + da, b + db});
  }
  return reached.back() != 0;
}

// True if the piece of the square cuts off (0, 0) or (1, 1).
bool cuts_off_diagonal(const Piece& p) {
  return (p.a.x == 0 || p.b.x == 0) == (p.a.y == 0 || p.b.y == 0);
}

std::vector<Point> sites_near(const std::vector<Piece>& curve, std::size_t count, Random& random) {
  std::vector<Point> sites;
  while (sites.size() < count) {
    const Piece& p = curve[random.below(static_cast<std::uint32_t>(curve.size()))];
    sites.push_back(between(p.a, p.b, random.uniform(0, 1)));
  }
  return sites;
}

std::size_t nearest(const std::vector<Point>& sites, const Point& p) {
  std::size_t best = 0;
  for (std::size_t s = 1; s < sites.size(); ++s) {
    if (distance(p, sites[s]) < distance(p, sites[best])) best = s;
  }
  return best;
}

}  // namespace

TEST_CASE("known curves are closed, and as many as they are") {
  const std::pair<Picture, std::size_t> cases[] = {
      {circle(), 1}, {two_circles(), 2}, {ovals(0.98), 2}, {ovals(1.02), 1}};
  for (const auto& [g, count] : cases) {
    const std::vector<Piece> curve = curve_of(g);
    CHECK(count_curves(curve) == count);
    for (const auto& [point, ends] : ends_at(curve)) CHECK(ends == 2);
  }
  double length = 0;
  for (const Piece& p : curve_of(circle())) {
    length += distance(p.a, p.b);
    CHECK(distance(p.a, {9.3, 8.2}) == doctest::Approx(6.1).epsilon(0.01));
  }
  CHECK(length == doctest::Approx(2 * 3.14159265 * 6.1).epsilon(0.01));
}

TEST_CASE("noise: a point on each side with one end inside, where g is 0; curves end on the rim") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    const Picture g = noise(seed);
    std::map<Key, int> ends = ends_at(curve_of(g));
    const auto check_side = [&](int i, int j, int di, int dj, bool on_rim) {
      const double a = g.at(i, j), b = g.at(i + di, j + dj);
      if ((a >= 0) == (b >= 0)) return;
      const double t = a / (a - b);
      const auto near = std::ranges::find_if(ends, [&](const auto& e) {
        return std::hypot(e.first.first - i - t * di, e.first.second - j - t * dj) < 1e-12;
      });
      REQUIRE(near != ends.end());
      CHECK(near->second == (on_rim ? 1 : 2));
      ends.erase(near);
    };
    for (int j = 0; j < g.rows; ++j) {
      for (int i = 0; i < g.columns; ++i) {
        if (i + 1 < g.columns) check_side(i, j, 1, 0, j == 0 || j + 1 == g.rows);
        if (j + 1 < g.rows) check_side(i, j, 0, 1, i == 0 || i + 1 == g.columns);
      }
    }
    CHECK(ends.empty());
  }
}

TEST_CASE(
    "alternating corners: the pieces leave those joined that the bilinear interpolant joins") {
  Random random(1);
  int joined = 0, apart = 0, inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double sign = trial % 2 == 0 ? 1 : -1;
    const auto size = [&] { return random.uniform(0.05, 1); };
    const Picture g{2, 2, {sign * size(), -sign * size(), -sign * size(), sign * size()}};
    const double even = g.at(0, 0) * g.at(1, 1), odd = g.at(1, 0) * g.at(0, 1);
    if (std::abs(even - odd) < 0.02) continue;  // too fine for the flood
    CAPTURE(trial);
    const std::vector<Piece> curve = curve_of(g);
    REQUIRE(curve.size() == 2);
    const bool is_joined = diagonal_joined(g, 0, 0);
    for (const Piece& p : curve) {
      CHECK(cuts_off_diagonal(p) == !is_joined);
    }
    ++(is_joined ? joined : apart);
    inside += is_joined && sign > 0;
  }
  CHECK(joined > 100);
  CHECK(apart > 100);
  CHECK(inside > 40);
}

TEST_CASE("a sample of 0 is inside") {
  const auto around = [](double middle, double other) {
    return sampled_picture(3, 3,
                           [&](double x, double y) { return x == 1 && y == 1 ? middle : other; });
  };
  CHECK(curve_of(around(0, -1)).size() == 4);
  CHECK(curve_of(around(0, 1)).empty());
  // A saddle of 0 is inside, too.
  for (const double sign : {1.0, -1.0}) {
    for (const Piece& p : curve_of({2, 2, {sign, -sign, -sign, sign}})) {
      CHECK(cuts_off_diagonal(p) == (sign < 0));
    }
  }
}

TEST_CASE("every part is nearest to its site, and the parts make up the pieces") {
  Random random(2);
  std::size_t cut_twice = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const Picture pictures[] = {circle(), two_circles(), ovals(1.02), noise(7)};
    const std::vector<Piece> curve = curve_of(pictures[trial % 4]);
    const std::vector<Point> sites = sites_near(curve, 1 + random.below(80), random);
    const RestrictedVoronoi v = restricted_voronoi(curve, sites);
    std::size_t part = 0, crossing = 0;
    for (const Piece& piece : curve) {
      Point at = piece.a;
      std::size_t cuts = 0;
      while (true) {
        REQUIRE(part < v.parts.size());
        const Part& now = v.parts[part++];
        REQUIRE(now.a == at);
        REQUIRE(now.site >= 0);
        REQUIRE(static_cast<std::size_t>(now.site) < sites.size());
        for (const double t : {0.001, 0.25, 0.5, 0.75, 0.999}) {
          const Point p = between(now.a, now.b, t);
          const double least = distance(p, sites[nearest(sites, p)]);
          CHECK(distance(p, sites[static_cast<std::size_t>(now.site)]) <= least + 1e-9);
        }
        at = now.b;
        if (at == piece.b) break;
        REQUIRE(part < v.parts.size());
        REQUIRE(crossing < v.crossings.size());
        const Crossing& x = v.crossings[crossing++];
        CHECK(x.x == at);
        CHECK(std::pair(x.low, x.high) == std::minmax({now.site, v.parts[part].site}));
        CHECK(x.low != x.high);
        ++cuts;
      }
      cut_twice += cuts > 1;
    }
    CHECK(part == v.parts.size());
    CHECK(crossing == v.crossings.size());
  }
  CHECK(cut_twice > 50);
}

TEST_CASE("many sites on a circle make a polygon; the cells of two meet twice") {
  const std::vector<Piece> curve = curve_of(circle());
  const auto joined = [&](const std::vector<double>& angles) {
    std::vector<Point> sites;
    for (const double a : angles)
      sites.push_back({9.3 + 6.1 * std::cos(a), 8.2 + 6.1 * std::sin(a)});
    std::map<std::pair<int, int>, int> edges;
    for (const Crossing& x : restricted_voronoi(curve, sites).crossings) ++edges[{x.low, x.high}];
    return edges;
  };
  std::vector<double> angles;
  for (int n = 0; n < 12; ++n) angles.push_back(0.01 + n * 3.14159265 / 6);
  const auto polygon = joined(angles);
  CHECK(polygon.size() == 12);
  for (const auto& [edge, times] : polygon) {
    CHECK(times == 1);
    CHECK((edge.second - edge.first == 1 || edge == std::pair(0, 11)));
  }
  // The Voronoi edge of two sites is a line, which meets the circle twice: insert a point there.
  CHECK(joined({0.3, 2.9}) == std::map<std::pair<int, int>, int>{{{0, 1}, 2}});
  CHECK(joined({0.3}).empty());
}
