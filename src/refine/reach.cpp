// SPDX-License-Identifier: MIT
#include "refine/reach.h"

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
FarPoint nearest(const TriMesh& mesh, const BoxGrid& grid, std::uint32_t witness, const Vec3& p,
                 double radius) {
  FarPoint best{witness, kNoId, 0};
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

void keep_far(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> witnesses,
              double limit, std::vector<std::uint32_t>& numbers) {
  // The facets that were near to the last few, the last one first.
  std::array<FaceId, 4> recent;
  recent.fill(kNoId);
  std::erase_if(numbers, [&](std::uint32_t n) {
    const Vec3& p = witnesses[n];
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

std::vector<FarPoint> furthest(const TriMesh& mesh, const BoxGrid& grid,
                               std::span<const Vec3> witnesses, double limit,
                               std::span<const std::uint32_t> numbers) {
  std::vector<FarPoint> far;
  for (const std::uint32_t n : numbers) {
    const FarPoint at = nearest(mesh, grid, n, witnesses[n], 2 * limit);
    if (at.facet != kNoId) far.push_back(at);
  }
  const auto furthest_of_facet = [](const FarPoint& a, const FarPoint& b) {
    return std::tie(a.facet, b.distance2, a.witness) < std::tie(b.facet, a.distance2, b.witness);
  };
  std::sort(far.begin(), far.end(), furthest_of_facet);
  far.erase(std::unique(far.begin(), far.end(),
                        [](const FarPoint& a, const FarPoint& b) { return a.facet == b.facet; }),
            far.end());
  std::sort(far.begin(), far.end(), [](const FarPoint& a, const FarPoint& b) {
    return std::tie(b.distance2, a.witness) < std::tie(a.distance2, b.witness);
  });
  return far;
}

}  // namespace deliso
