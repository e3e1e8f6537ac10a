// SPDX-License-Identifier: MIT
#include "surface/surface_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

// A square of n x n cells of two facets each, flat, its vertices moved at random.
SurfaceMesh square(int n, Random& random) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      points.push_back({i + random.uniform(-0.3, 0.3), j + random.uniform(-0.3, 0.3), 0});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const VertexId a(i + (n + 1) * j), b(a + 1), d(a + n + 1), c(d + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  SurfaceMesh s;
  s.mesh = make_tri_mesh(points, triangles);
  for (const Triangle& t : triangles) {
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    s.duals.push_back(dual_at(a, b, c, circumcenter(a, b, c)));
  }
  return s;
}

// The facets connected to `start` of those whose balls hold p, and `start`: by passing over all
// facets until none is added.
std::vector<FaceId> encroached_by_passes(const SurfaceMesh& s, FaceId start, const Vec3& p) {
  std::vector<std::uint8_t> in(s.mesh.faces.size(), 0);
  in[start] = 1;
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
      const Dual& dual = s.duals[f];
      if (in[f] || distance2(dual.center, p) >= (1 - 2e-9) * dual.radius2) continue;
      for (const FaceId g : s.mesh.faces[f].n) any |= g != kNoId && in[g] && !in[f] && ++in[f];
    }
  }
  std::vector<FaceId> facets;
  for (FaceId f = 0; f < in.size(); ++f) {
    if (in[f]) facets.push_back(f);
  }
  return facets;
}

}  // namespace

TEST_CASE("the facets encroached upon are those around the start whose balls hold the point") {
  std::size_t large = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    SurfaceMesh s = square(8, random);
    // Larger balls give large cavities, and some that are no disks.
    for (Dual& dual : s.duals) dual.radius2 *= random.uniform(1, 6);
    std::vector<FaceId> found;
    for (int n = 0; n < 5; ++n) {
      const FaceId start(random.below(static_cast<std::uint32_t>(s.mesh.faces.size())));
      const Vec3 p = s.duals[start].center + Vec3{random.uniform(-1, 1), random.uniform(-1, 1), 0};
      facets_encroached(s, start, p, found);
      REQUIRE(found.front() == start);
      std::sort(found.begin(), found.end());
      REQUIRE(found == encroached_by_passes(s, start, p));
      large += found.size() > 12;
    }
  }
  CHECK(large > 100);
}
