// SPDX-License-Identifier: MIT
#include "refine/coverage.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/triangle.h"

namespace deliso {
namespace {

// Steps from facet to facet towards a sample before the hash is asked.
constexpr int kSteps = 6;

// Returns the facet across the first edge of f that p lies beyond; kNoId if there is none.
FaceId towards(const TriMesh& mesh, FaceId f, const Vec3& p) {
  const Face& face = mesh.faces[f];
  const std::array<Vec3, 3> at{mesh.points[face.v[0]], mesh.points[face.v[1]],
                               mesh.points[face.v[2]]};
  const Vec3 normal = area_normal(at[0], at[1], at[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = at[(i + 1) % 3], &to = at[(i + 2) % 3];
    if (dot(cross(to - from, normal), p - from) > 0) return face.n[i];
  }
  return kNoId;
}

}  // namespace

std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers) {
  std::vector<FarSample> far;
  // Per cell, the facet that was near the last sample there: the next one is often near it too. The
  // table is periodic in space.
  constexpr std::size_t kCells = 16;
  constexpr double kCellLimits = 8;  // side of a cell, in `limit`
  std::array<FaceId, kCells * kCells * kCells> guesses;
  guesses.fill(kNoId);
  FaceId last = kNoId;
  std::erase_if(numbers, [&](std::uint32_t n) {
    const Vec3& p = samples[n];
    const auto distance2 = [&](FaceId f) {
      const Triangle& v = mesh.faces[f].v;
      return distance2_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    };
    const auto is_near = [&](FaceId f) {
      if (f == kNoId || distance2(f) > limit * limit) return false;
      last = f;
      return true;
    };
    std::size_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      cell = kCells * cell + static_cast<std::size_t>(p[axis] / (kCellLimits * limit)) % kCells;
    }
    // Walks over the mesh to a facet that p is over, or to an edge that p is beyond from both
    // sides. Nothing depends on where that ends.
    const auto is_reached = [&](FaceId f) {
      FaceId before = kNoId;
      for (int step = 0; step < kSteps && f != kNoId; ++step) {
        const FaceId next = towards(mesh, f, p);
        if (next == kNoId || next == before) return is_near(f) || is_near(before);
        before = std::exchange(f, next);
      }
      return false;
    };
    if (is_reached(last) || is_reached(guesses[cell]) ||
        grid.any(grid.box_around(p, limit), [&](FaceId f, const auto&) { return is_near(f); })) {
      guesses[cell] = last;
      return true;
    }
    // Searches for the nearest facet in growing balls.
    FarSample at{n, kNoId, 0};
    double radius = 2 * limit;
    for (int doublings = 0; at.facet == kNoId && doublings < 32; ++doublings, radius *= 2) {
      at.distance2 = radius * radius;
      grid.any(grid.box_around(p, radius), [&](FaceId f, const auto&) {
        const double d2 = distance2(f);
        if (std::tie(d2, f) < std::tie(at.distance2, at.facet)) {
          at.distance2 = d2;
          at.facet = f;
        }
        return false;
      });
    }
    if (at.facet != kNoId) far.push_back(at);
    return false;
  });
  std::ranges::sort(far, {},
                    [](const FarSample& a) { return std::tuple(a.facet, -a.distance2, a.sample); });
  const auto of_one_facet = [](const FarSample& a, const FarSample& b) {
    return a.facet == b.facet;
  };
  far.erase(std::unique(far.begin(), far.end(), of_one_facet), far.end());
  std::ranges::sort(far, {}, [](const FarSample& a) { return std::tuple(-a.distance2, a.sample); });
  return far;
}

}  // namespace deliso
