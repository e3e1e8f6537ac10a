// SPDX-License-Identifier: MIT
#include "refine/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// Finds facets near samples of which most are near the one before.
class NearFacets {
 public:
  // `side`: of the cells below.
  NearFacets(const TriMesh& mesh, const BoxGrid& grid, double side)
      : mesh_(mesh), grid_(grid), side_(side) {
    guesses_.fill(kNoId);
  }

  // True if a facet is within `limit` of p.
  bool is_near(const Vec3& p, double limit) {
    const auto is_near = [&](FaceId f) {
      if (f == kNoId || distance2(f, p) > limit * limit) return false;
      last_ = f;
      return true;
    };
    // Walks over the mesh to a facet that p is over, or to an edge that p is beyond from both
    // sides. Nothing depends on where that ends.
    const auto is_reached = [&](FaceId f) {
      FaceId before = kNoId;
      for (int step = 0; step < kSteps && f != kNoId; ++step) {
        const FaceId next = towards(mesh_, f, p);
        if (next == kNoId || next == before) return is_near(f) || is_near(before);
        before = std::exchange(f, next);
      }
      return false;
    };
    std::size_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      cell = kCells * cell + static_cast<std::size_t>(p[axis] / side_) % kCells;
    }
    if (!is_reached(last_) && !is_reached(guesses_[cell]) &&
        !grid_.any(grid_.box_around(p, limit), [&](FaceId f, const auto&) { return is_near(f); })) {
      return false;
    }
    guesses_[cell] = last_;
    return true;
  }

  // Returns the facet nearest to p, found in growing balls; kNoId if all are very far.
  FarSample nearest(std::uint32_t sample, const Vec3& p, double radius) const {
    FarSample at{sample, kNoId, 0};
    for (int doublings = 0; at.facet == kNoId && doublings < 32; ++doublings, radius *= 2) {
      at.distance2 = radius * radius;
      grid_.any(grid_.box_around(p, radius), [&](FaceId f, const auto&) {
        const double d2 = distance2(f, p);
        if (std::tie(d2, f) < std::tie(at.distance2, at.facet)) {
          at.distance2 = d2;
          at.facet = f;
        }
        return false;
      });
    }
    return at;
  }

 private:
  double distance2(FaceId f, const Vec3& p) const {
    const Triangle& v = mesh_.faces[f].v;
    return distance2_to_triangle(p, mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }

  static constexpr std::size_t kCells = 16;

  const TriMesh& mesh_;
  const BoxGrid& grid_;
  const double side_;
  // Per cell, the facet that was near the last sample there: the next one is often near it too. The
  // table is periodic in space.
  std::array<FaceId, kCells * kCells * kCells> guesses_;
  FaceId last_ = kNoId;
};

}  // namespace

std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers) {
  std::vector<FarSample> far;
  constexpr double kCellLimits = 8;  // side of a cell, in `limit`
  NearFacets facets(mesh, grid, kCellLimits * limit);
  std::erase_if(numbers, [&](std::uint32_t n) {
    if (facets.is_near(samples[n], limit)) return true;
    const FarSample at = facets.nearest(n, samples[n], 2 * limit);
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

double furthest_distance(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples,
                         double resolution) {
  constexpr double kCellResolutions = 8;
  NearFacets facets(mesh, grid, kCellResolutions * resolution);
  double furthest = 0;
  for (const Vec3& p : samples) {
    if (facets.is_near(p, furthest)) continue;
    furthest = std::sqrt(facets.nearest(0, p, std::max(2 * furthest, resolution)).distance2);
  }
  return furthest;
}

}  // namespace deliso
