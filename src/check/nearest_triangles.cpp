// SPDX-License-Identifier: MIT
#include "check/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "base/parallel.h"

namespace deliso {
namespace {

constexpr std::size_t kPointsPerTask = 1u << 14;
constexpr std::size_t kPatchPoints = 16;    // neighbors that share one query
constexpr std::size_t kMaxCandidates = 64;  // for a patch
constexpr double kMargin = 1.0 / 16;        // of a query around a patch, in sides of a cube

// The numbers of points, sorted by cubes of space, of which there are about half as many as points.
struct Cubes {
  double side = 0;
  std::vector<std::uint32_t> end, order;  // the points of cube n are order[end[n - 1] .. end[n])
};

Cubes sort_into_cubes(std::span<const Vec3> points) {
  Box3 box{points[0], points[0]};
  for (const Vec3& p : points) box = united(box, {p, p});
  const Vec3 size = box.size();
  const double area = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  const double longest = std::max({size.x, size.y, size.z});
  const auto n = static_cast<double>(points.size());
  const double side = std::max(
      {cube_root(2 * size.x * size.y * size.z / n), std::sqrt(2 * area / n), 2 * longest / n});
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
  return {side, std::move(next), std::move(order)};
}

class RunOfPoints {
 public:
  RunOfPoints(std::span<const Vec3> points, const TriangleTree& tree,
              std::span<NearestTriangle> found)
      : points_(points), tree_(tree), found_(found) {}

  void measure() {
    const Cubes cubes = sort_into_cubes(points_);
    margin_ = kMargin * cubes.side;
    std::size_t begin = 0;
    for (const std::size_t end : cubes.end) {
      for (; begin < end; begin += std::min(kPatchPoints, end - begin)) {
        measure_patch(std::span(cubes.order).subspan(begin, std::min(kPatchPoints, end - begin)));
      }
    }
  }

 private:
  struct Candidate {
    Box3 box;
    FaceId triangle;
  };

  // One query finds the triangles near a patch. Points that are further than the margin from all of
  // these search the tree on their own.
  void measure_patch(std::span<const std::uint32_t> patch) {
    Box3 box{points_[patch[0]], points_[patch[0]]};
    for (const std::uint32_t i : patch) box = united(box, {points_[i], points_[i]});
    const Box3 around = box.grown(margin_);
    candidates_.clear();
    std::size_t boxes_tested = 0, leaves = 0;
    tree_.for_each_leaf_near(box, margin_, 0, boxes_tested, [&](std::size_t leaf, const Box3&) {
      ++leaves;
      const std::span<const FaceId> faces = tree_.leaf(leaf);
      const std::span<const Box3> boxes = tree_.boxes_of_leaf(leaf);
      for (std::size_t n = 0; n < faces.size(); ++n) {
        if (meet(boxes[n], around)) candidates_.push_back({boxes[n], faces[n]});
      }
      return candidates_.size() <= kMaxCandidates;
    });
    leaves_left_ -= std::min(leaves_left_, leaves);
    const bool all = candidates_.size() <= kMaxCandidates;
    if (!all && patch.size() > 1) {
      measure_patch(patch.first(patch.size() / 2));
      measure_patch(patch.subspan(patch.size() / 2));
      return;
    }
    for (const std::uint32_t i : patch) {
      const Vec3& p = points_[i];
      NearestTriangle best{near_, tree_.distance2(near_, p)};
      for (const Candidate& candidate : candidates_) {
        if (!(distance2_to(candidate.box, p) < best.distance2)) continue;
        if (candidate.triangle == near_) continue;
        const double d = tree_.distance2(candidate.triangle, p);
        if (d < best.distance2) best = {candidate.triangle, d};
      }
      if (!all || best.distance2 > margin_ * margin_) {
        const NearestTriangle nearer = tree_.nearest(p, best.distance2, &leaves_left_);
        if (nearer.triangle != kNoId) best = nearer;
      }
      near_ = best.triangle;
      found_[i] = best;
      if (leaves_left_ == 0) found_[i].distance2 = kGivenUp;
    }
  }

  std::span<const Vec3> points_;
  const TriangleTree& tree_;
  std::span<NearestTriangle> found_;
  std::size_t leaves_left_ = kMaxLeavesPerTask;
  double margin_ = 0;
  std::vector<Candidate> candidates_;
  FaceId near_ = 0;  // of the last point
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
