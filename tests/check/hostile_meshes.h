// SPDX-License-Identifier: MIT
// Hostile meshes: each has about n triangles, and makes some step of the check cost the square of
// n.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/random.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

struct Hostile {
  std::string name;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  VertexId add(const Vec3& p) {
    points.push_back(p);
    return VertexId(points.size() - 1);
  }
};

// Triangles around one vertex, with the others at place(0), place(1), ...
template <class Place>
Hostile fan(std::string name, const Vec3& center, std::size_t n, const Place& place) {
  Hostile h{std::move(name), {center}, {}};
  for (std::size_t i = 0; i <= n; ++i) h.add(place(static_cast<double>(i)));
  for (VertexId i = 1; i <= n; ++i) h.triangles.push_back(triangle_of(0, i, i + 1));
  return h;
}

// Meshes within the box from 0 to `side`.
inline std::vector<Hostile> hostile_meshes(std::size_t n, double side) {
  std::vector<Hostile> all;
  const double half = 0.5 * side, step = 1 / static_cast<double>(n);
  const Vec3 middle{half, half, half};

  Hostile copies{"copies of one triangle", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const VertexId a = copies.add({0, 0, 0}), b = copies.add({side, 0, half});
    copies.triangles.push_back({a, b, copies.add({0, side, half})});
  }
  all.push_back(copies);
  all.push_back(fan("fan with a helix for its boundary", {half, half, 0}, n, [&](double i) {
    const double u = 20 * i * step;
    return Vec3{half + 0.4 * side * std::cos(u), half + 0.4 * side * std::sin(u), side * i * step};
  }));
  all.push_back(fan("flat fan", middle, n, [&](double i) {
    const double u = 6 * i * step;
    return Vec3{half + 0.4 * side * std::cos(u), half + 0.4 * side * std::sin(u), half};
  }));
  all.push_back(fan("fan wound up ten times", middle, n, [&](double i) {
    const double u = 60 * i * step;
    return Vec3{half + 0.4 * side * std::cos(u), half + 0.4 * side * std::sin(u), half};
  }));
  all.push_back(fan("all vertices on a moment curve", {0, 0, 0}, n, [&](double i) {
    const double u = (i + 1) * step;
    return Vec3{side * u, side * u * u, side * u * u * u};
  }));

  Hostile crossing{"triangles that all cross each other", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const double u = 3 * static_cast<double>(i) * step, x = half * std::cos(u),
                 y = half * std::sin(u);
    const VertexId a = crossing.add(middle + 0.9 * Vec3{x, y, -half});
    const VertexId b = crossing.add(middle + 0.9 * Vec3{-x, -y, -half});
    crossing.triangles.push_back({a, b, crossing.add(middle + 0.9 * Vec3{0.1 * x, 0.1 * y, half})});
  }
  all.push_back(crossing);

  Hostile point{"all vertices at one point", {}, {}}, line{"all vertices on one line", {}, {}};
  Random random(1);
  for (VertexId i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      point.add(middle);
      const double u = random.uniform(0, side);
      line.add({u, u, u});
    }
    point.triangles.push_back(triangle_of(3 * i, 3 * i + 1, 3 * i + 2));
    line.triangles.push_back(triangle_of(3 * i, 3 * i + 1, 3 * i + 2));
  }
  all.push_back(point);
  all.push_back(line);

  Hostile needles{"needles across the box", {}, {}};
  Hostile far{"vertices far outside", {}, {}};
  Hostile crumbs{"as many components as triangles", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = [&](double lo, double hi) {
      return Vec3{random.uniform(lo, hi), random.uniform(lo, hi), random.uniform(lo, hi)};
    };
    Vec3 a = at(0, side), b = at(0, side);
    a.x = 0;
    b.x = side;
    const VertexId p = needles.add(a), q = needles.add(a + 1e-3 * side * at(0, 1));
    needles.triangles.push_back({p, q, needles.add(b)});
    const VertexId u = far.add(at(-1e6, 1e6)), v = far.add(at(-1e6, 1e6));
    far.triangles.push_back({u, v, far.add(at(-1e6, 1e6))});
    const Vec3 c = at(0, side);
    const VertexId s = crumbs.add(c), t = crumbs.add(c + 0.01 * at(-1, 1));
    crumbs.triangles.push_back({s, t, crumbs.add(c + 0.01 * at(-1, 1))});
  }
  all.push_back(needles);
  all.push_back(far);
  all.push_back(crumbs);

  // Two poles over a circle on a sphere around the middle: all vertices are cospherical.
  Hostile spindle{"two poles of a sphere", {}, {}};
  const VertexId north = spindle.add(middle + Vec3{0, 0, 0.4 * side});
  const VertexId south = spindle.add(middle - Vec3{0, 0, 0.4 * side});
  const auto ring = VertexId(n / 2);
  for (VertexId i = 0; i < ring; ++i) {
    const double u = 2 * 3.14159265358979 * i / ring;
    spindle.add(middle + 0.4 * side * Vec3{std::cos(u), std::sin(u), 0});
  }
  for (VertexId i = 0; i < ring; ++i) {
    const VertexId here(2 + i), next(2 + (i + 1) % ring);
    spindle.triangles.push_back({north, here, next});
    spindle.triangles.push_back({south, next, here});
  }
  all.push_back(spindle);
  return all;
}

}  // namespace deliso::test
