// SPDX-License-Identifier: MIT
#include "check/nearest_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/elementary.h"
#include "base/parallel.h"

namespace deliso {
namespace {

constexpr std::size_t kPointsPerTask = 1u << 14;
constexpr std::size_t kPatchPoints = 16;  // neighbors that share one query

// The numbers of points, sorted by cubes of space, of which there are about as many as points.
struct Cubes {
  std::vector<std::uint32_t> end, order;  // the points of cube n are order[end[n - 1] .. end[n])
};

Cubes sort_into_cubes(std::span<const Vec3> points) {
  Box3 box{points[0], points[0]};
  for (const Vec3& p : points) box = united(box, {p, p});
  const Vec3 size = box.size();
  const double area = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  const double longest = std::max({size.x, size.y, size.z});
  const auto n = static_cast<double>(points.size());
  const double side =
      std::max({cube_root(size.x * size.y * size.z / n), std::sqrt(area / n), longest / n});
  const auto cell = [&](const Vec3& p, int axis) {
    return side > 0 ? static_cast<std::size_t>((p[axis] - box.lo[axis]) / side) : 0;
  };
  const std::size_t columns = cell(box.hi, 0) + 1, rows = cell(box.hi, 1) + 1;
  const auto cube = [&](const Vec3& p) {
    return cell(p, 0) + columns * (cell(p, 1) + rows * cell(p, 2));
  };
  std::vector<std::uint32_t> next(cube(box.hi) + 2, 0), order(points.size());
  for (const Vec3& p : points) ++next[cube(p) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::uint32_t i = 0; i < points.size(); ++i) order[next[cube(points[i])]++] = i;
  next.pop_back();
  return {std::move(next), std::move(order)};
}

class RunOfPoints {
 public:
  RunOfPoints(std::span<const Vec3> points, const TriangleTree& tree,
              std::span<NearestTriangle> found)
      : points_(points), tree_(tree), found_(found) {}

  void measure() {
    const Cubes cubes = sort_into_cubes(points_);
    std::size_t begin = 0;
    for (const std::size_t end : cubes.end) {
      for (; begin < end; begin += std::min(kPatchPoints, end - begin)) {
        measure_patch(std::span(cubes.order).subspan(begin, std::min(kPatchPoints, end - begin)));
      }
    }
  }

 private:
  // One query finds the triangles near a patch. For each point of the patch, the nearest triangle
  // is no further than the one nearest to the first point.
  void measure_patch(std::span<const std::uint32_t> patch) {
    const Vec3& first = points_[patch[0]];
    const double least = tree_.distance2(near_, first);
    const NearestTriangle nearest = tree_.nearest(first, least, &leaves_left_);
    if (leaves_left_ == 0) {
      for (const std::uint32_t i : patch) found_[i].distance2 = kGivenUp;
      return;
    }
    if (nearest.triangle != kNoId) near_ = nearest.triangle;
    found_[patch[0]] = {near_, nearest.distance2};
    if (patch.size() == 1) return;

    std::array<NearestTriangle, kPatchPoints> best{};
    double most = 0;
    Box3 box{first, first};
    for (std::size_t n = 0; n < patch.size(); ++n) {
      const Vec3& p = points_[patch[n]];
      box = united(box, {p, p});
      best[n] = {near_, tree_.distance2(near_, p)};
      most = std::max(most, best[n].distance2);
    }
    const double reach = std::sqrt(most);
    std::array<std::pair<std::size_t, const Box3*>, kMaxPatchLeaves> leaves;
    std::size_t count = 0, boxes_tested = 0;
    bool room = true;
    tree_.for_each_leaf_near(box, reach, 0, boxes_tested,
                             [&](std::size_t leaf, const Box3& of_leaf) {
                               room = count < kMaxPatchLeaves;
                               if (room) leaves[count++] = {leaf, &of_leaf};
                               return room;
                             });
    leaves_left_ -= std::min(leaves_left_, count);
    if (!room) {
      measure_patch(patch.first(patch.size() / 2));
      measure_patch(patch.subspan(patch.size() / 2));
      return;
    }
    for (std::size_t n = 0; n < patch.size(); ++n) {
      const Vec3& p = points_[patch[n]];
      for (std::size_t k = 0; k < count; ++k) {
        if (distance2_to(*leaves[k].second, p) < best[n].distance2)
          tree_.improve(leaves[k].first, p, best[n]);
      }
      found_[patch[n]] = best[n];
    }
  }

  static constexpr std::size_t kMaxPatchLeaves = 16;

  std::span<const Vec3> points_;
  const TriangleTree& tree_;
  std::span<NearestTriangle> found_;
  std::size_t leaves_left_ = kMaxLeavesPerTask;
  FaceId near_ = 0;
};

}  // namespace

std::vector<NearestTriangle> nearest_triangles(std::span<const Vec3> points,
                                               const TriangleTree& tree, int threads) {
  std::vector<NearestTriangle> found(points.size());
  if (tree.leaf_count() == 0) return found;
  for_each_run(threads, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    RunOfPoints(points.subspan(begin, end - begin), tree,
                std::span(found).subspan(begin, end - begin))
        .measure();
  });
  return found;
}

}  // namespace deliso
