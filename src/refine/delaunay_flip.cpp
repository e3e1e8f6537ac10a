// SPDX-License-Identifier: MIT
#include "refine/delaunay_flip.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "mesh/encroach.h"

namespace deliso {
namespace {

// By so much of it must a flip lower the sum of radii: more than rounding.
constexpr double kLower = 1e-9;

// An edge may be this sharp, or as sharp as before: the cosine between its facets' normals.
constexpr double kLeastCosine = 0.5;

}  // namespace

std::optional<std::array<Vec3, 2>> delaunay_flip(const TriMesh& mesh, const Quad& quad,
                                                 SurfacePointFinder& finder,
                                                 SearchCounters& counters) {
  const Vec3 &a = mesh.points[quad.a], &b = mesh.points[quad.b], &c = mesh.points[quad.c],
             &d = mesh.points[quad.d];
  if (!is_encroached(mesh, quad.f, d) && !is_encroached(mesh, quad.g, a)) return std::nullopt;
  if (has_diagonal(mesh, quad)) return std::nullopt;
  const auto x = finder.find(a, b, d, counters);
  const auto y = x ? finder.find(d, c, a, counters) : std::nullopt;
  if (!y) return std::nullopt;
  const bool are_delaunay =
      distance2(*x, c) >= distance2(*x, a) && distance2(*y, b) >= distance2(*y, a);
  if (!are_delaunay) return std::nullopt;
  const auto radius = [](const Vec3& center, const Vec3& u, const Vec3& v, const Vec3& w) {
    return std::sqrt(std::max({distance2(center, u), distance2(center, v), distance2(center, w)}));
  };
  const double radii =
      radius(mesh.surface_points[quad.f], a, b, c) + radius(mesh.surface_points[quad.g], d, c, b);
  if (!(radius(*x, a, b, d) + radius(*y, d, c, a) < (1 - kLower) * radii)) return std::nullopt;
  const Vec3 n1 = area_normal(a, b, c), n2 = area_normal(d, c, b), m1 = area_normal(a, b, d),
             m2 = area_normal(d, c, a);
  const auto cosine = [](const Vec3& u, const Vec3& v) {
    return dot(u, v) / std::sqrt(length2(u) * length2(v));
  };
  if (cosine(m1, m2) < std::min(kLeastCosine, cosine(n1, n2))) return std::nullopt;
  return std::array{*x, *y};
}

}  // namespace deliso
