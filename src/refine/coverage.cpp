// SPDX-License-Identifier: MIT
#include "refine/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/box3.h"
#include "base/triangle.h"
#include "volume/volume.h"

namespace deliso {
namespace {

// Samples, listed by cells. The cells are wrapped into one table.
class SampleCells {
 public:
  SampleCells(std::span<const Vec3> samples, std::span<const std::uint32_t> numbers, double cell)
      : samples_(samples),
        per_cell_(1 / cell),
        first_(std::bit_ceil(numbers.size() / kPerList + 1), kEnd),
        next_(samples.size(), kEnd) {
    for (const std::uint32_t n : numbers) {
      const Index3 at = cell_at(samples[n]);
      next_[n] = std::exchange(first_[list_of(row_of(at), at.i)], n);
    }
  }

  // Removes samples for which pred(point) holds: all of them in the box, perhaps some elsewhere.
  template <class Predicate>
  void remove_if(const Box3& box, Predicate&& pred) {
    const Index3 lo = cell_at(box.lo), hi = cell_at(box.hi);
    const double cells = (hi.i - lo.i + 1.0) * (hi.j - lo.j + 1.0) * (hi.k - lo.k + 1.0);
    if (cells > static_cast<double>(first_.size())) {
      for (std::uint32_t& list : first_) remove_if(list, pred);
      return;
    }
    Index3 at;
    for (at.k = lo.k; at.k <= hi.k; ++at.k) {
      for (at.j = lo.j; at.j <= hi.j; ++at.j) {
        const std::size_t row = row_of(at);
        for (at.i = lo.i; at.i <= hi.i; ++at.i) {
          remove_if(first_[list_of(row, at.i)], pred);
        }
      }
    }
  }
  bool was_removed(std::uint32_t n) const { return next_[n] == kRemoved; }

 private:
  // Samples for which there is a list.
  static constexpr std::size_t kPerList = 8;
  static constexpr std::uint32_t kEnd = 0xffffffff, kRemoved = kEnd - 1;

  Index3 cell_at(const Vec3& p) const {
    return {static_cast<int>(per_cell_ * p.x), static_cast<int>(per_cell_ * p.y),
            static_cast<int>(per_cell_ * p.z)};
  }
  static std::size_t row_of(Index3 at) {
    return static_cast<std::uint32_t>(at.j) * 0x9e3779b1u +
           static_cast<std::uint32_t>(at.k) * 0x85ebca77u;
  }
  std::size_t list_of(std::size_t row, int i) const {
    return (row + static_cast<std::size_t>(i)) & (first_.size() - 1);
  }
  template <class Predicate>
  void remove_if(std::uint32_t& list, Predicate&& pred) {
    for (std::uint32_t* n = &list; *n != kEnd;) {
      std::uint32_t& next = next_[*n];
      if (pred(samples_[*n])) {
        *n = std::exchange(next, kRemoved);
      } else {
        n = &next;
      }
    }
  }

  std::span<const Vec3> samples_;
  double per_cell_;
  std::vector<std::uint32_t> first_;  // per list
  std::vector<std::uint32_t> next_;   // in its list, of each sample
};

// Removes the samples over a facet within `limit` of its plane from `numbers`: nearly all, for a
// fraction of what a search in the hash costs.
void remove_covered(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples,
                    double limit, std::vector<std::uint32_t>& numbers) {
  SampleCells cells(samples, numbers, grid.cell());
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    const Vec3 &a = mesh.points[face.v[0]], &b = mesh.points[face.v[1]],
               &c = mesh.points[face.v[2]];
    const Vec3 u = b - a, v = c - a;
    const Vec3 normal = cross(u, v), along_u = cross(v, normal), along_v = cross(normal, u);
    const double normal2 = length2(normal), height2 = limit * limit * normal2;
    cells.remove_if(box_of(a, b, c), [&](const Vec3& p) {
      const Vec3 w = p - a;
      const double height = dot(normal, w), by_u = dot(along_u, w), by_v = dot(along_v, w);
      return height * height <= height2 && by_u >= 0 && by_v >= 0 && by_u + by_v <= normal2;
    });
  }
  std::erase_if(numbers, [&](std::uint32_t n) { return cells.was_removed(n); });
}

}  // namespace

double distance2_to_facet(const TriMesh& mesh, FaceId f, const Vec3& p) {
  const Triangle& v = mesh.faces[f].v;
  return distance2_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

FarSample nearest_facet(const TriMesh& mesh, const BoxGrid& grid, std::uint32_t sample,
                        const Vec3& p, double radius) {
  FarSample at{sample, kNoId, 0};
  for (int doublings = 0; at.facet == kNoId && doublings < 32; ++doublings, radius *= 2) {
    at.distance2 = radius * radius;
    grid.any(grid.box_around(p, radius), [&](FaceId f, const auto&) {
      const double d2 = distance2_to_facet(mesh, f, p);
      if (std::tie(d2, f) < std::tie(at.distance2, at.facet)) at = {sample, f, d2};
      return false;
    });
  }
  return at;
}

std::vector<FarSample> find_far(const TriMesh& mesh, const BoxGrid& grid,
                                std::span<const Vec3> samples, double limit,
                                std::vector<std::uint32_t>& numbers) {
  std::vector<FarSample> far;
  // The first time, when none was held against the mesh.
  if (numbers.size() == samples.size()) remove_covered(mesh, grid, samples, limit, numbers);
  std::erase_if(numbers, [&](std::uint32_t n) {
    const FarSample at = nearest_facet(mesh, grid, n, samples[n], limit);
    if (at.facet == kNoId) return false;
    if (at.distance2 <= limit * limit) return true;
    far.push_back(at);
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
