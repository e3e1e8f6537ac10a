// SPDX-License-Identifier: MIT
#include "refine/coverage.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/triangle.h"

namespace deliso {
namespace {

double distance2_to_facet(const TriMesh& mesh, FaceId f, const Vec3& p) {
  const Triangle& v = mesh.faces[f].v;
  return distance2_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

// The nearest facet, looked for in balls that grow.
FarSample nearest(const TriMesh& mesh, const BoxGrid& grid, std::uint32_t sample, const Vec3& p,
                  double radius) {
  FarSample best{sample, kNoId, 0};
  for (int doublings = 0; best.facet == kNoId && doublings < 32; ++doublings, radius *= 2) {
    best.distance2 = radius * radius;
    grid.any(grid.box_around(p, radius), [&](FaceId f, const BoxGrid::Box&) {
      const double d2 = distance2_to_facet(mesh, f, p);
      if (d2 < best.distance2 || (d2 == best.distance2 && f < best.facet)) {
        best.distance2 = d2;
        best.facet = f;
      }
      return false;
    });
  }
  return best;
}

}  // namespace

void keep_far(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples, double limit,
              std::vector<std::uint32_t>& numbers) {
  // The facets that were near to the last few, the last one first.
  std::array<FaceId, 4> recent;
  recent.fill(kNoId);
  std::erase_if(numbers, [&](std::uint32_t n) {
    const Vec3& p = samples[n];
    const auto is_near = [&](FaceId f) {
      return f != kNoId && distance2_to_facet(mesh, f, p) <= limit * limit;
    };
    const auto known = std::find_if(recent.begin(), recent.end(), is_near);
    if (known != recent.end()) {
      std::rotate(recent.begin(), known, known + 1);
      return true;
    }
    return grid.any(grid.box_around(p, limit), [&](FaceId f, const BoxGrid::Box&) {
      if (!is_near(f)) return false;
      std::rotate(recent.begin(), recent.end() - 1, recent.end());
      recent.front() = f;
      return true;
    });
  });
}

std::vector<FarSample> furthest(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::span<const std::uint32_t> numbers) {
  std::vector<FarSample> far;
  for (const std::uint32_t n : numbers) {
    const FarSample at = nearest(mesh, grid, n, samples[n], 2 * limit);
    if (at.facet != kNoId) far.push_back(at);
  }
  const auto furthest_of_facet = [](const FarSample& a, const FarSample& b) {
    return std::tie(a.facet, b.distance2, a.sample) < std::tie(b.facet, a.distance2, b.sample);
  };
  std::sort(far.begin(), far.end(), furthest_of_facet);
  far.erase(std::unique(far.begin(), far.end(),
                        [](const FarSample& a, const FarSample& b) { return a.facet == b.facet; }),
            far.end());
  std::sort(far.begin(), far.end(), [](const FarSample& a, const FarSample& b) {
    return std::tie(b.distance2, a.sample) < std::tie(a.distance2, b.sample);
  });
  return far;
}

}  // namespace deliso
