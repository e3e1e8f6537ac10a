// SPDX-License-Identifier: MIT
// The first facet on a line, against all facets.
#include "coarsen/whole_mesh.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"

namespace deliso {
namespace {

// Returns facets in the unit cube, from large ones down to a thousandth of it.
TriMesh scattered_facets(Random& random) {
  TriMesh mesh;
  const auto point = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
  for (std::uint32_t n = 0; n < 300; ++n) {
    const Vec3 at = point();
    const double size = std::pow(10, -3 * random.uniform());
    for (int corner = 0; corner < 3; ++corner) mesh.points.push_back(at + size * point());
    mesh.faces.push_back({triangle_of(3 * n, 3 * n + 1, 3 * n + 2), {kNoId, kNoId, kNoId}});
  }
  return mesh;
}

// Returns the facet but `from` that the line from p meets first, of all.
FaceId nearest_of_all(const TriMesh& mesh, FaceId from, const Vec3& p, int axis, double end) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto turn = [&](const Vec3& a, const Vec3& b) {
    return (b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u]);
  };
  FaceId met = kNoId;
  double nearest = std::abs(end - p[axis]);
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const auto& [i, j, k] = mesh.faces[f].v;
    const Vec3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const double of_a = turn(b, c), of_b = turn(c, a), of_c = turn(a, b);
    const bool is_inside = (of_a > 0 && of_b > 0 && of_c > 0) || (of_a < 0 && of_b < 0 && of_c < 0);
    if (f == from || !is_inside) continue;
    const double at = (of_a * a[axis] + of_b * b[axis] + of_c * c[axis]) / (of_a + of_b + of_c);
    const double distance = end > p[axis] ? at - p[axis] : p[axis] - at;
    if (distance > 0 && distance < nearest) nearest = distance, met = f;
  }
  return met;
}

}  // namespace

TEST_CASE("a line meets the nearest facet, near or far, up to its end") {
  std::size_t met = 0, nothing = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = scattered_facets(random);
    const WholeMesh whole(mesh);
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      const Vec3 p = whole.middle(f);
      for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {-1.0, p[axis] - 0.7, p[axis] + 0.1, p[axis] + 0.7, 3.0}) {
          const FaceId first = whole.first_met(f, p, axis, end);
          CHECK(first == nearest_of_all(mesh, f, p, axis, end));
          ++(first == kNoId ? nothing : met);
        }
      }
    }
  }
  CHECK(met > 1000);
  CHECK(nothing > 1000);
}

}  // namespace deliso
