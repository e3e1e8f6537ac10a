// SPDX-License-Identifier: MIT
#include "check/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "delaunay/hilbert.h"

namespace deliso {
namespace {

constexpr std::size_t kPointsPerTask = 1u << 14;
constexpr std::size_t kPatchPoints = 8;     // neighbors that share one query
constexpr std::size_t kMaxCandidates = 64;  // for a patch
constexpr double kMargin = 1.0 / 16;        // of a query around a patch, in sides of its box

// Returns the numbers of the points along Hilbert's curve.
std::vector<std::uint32_t> curve_order(std::span<const Vec3> points) {
  constexpr int kBits = 8;
  Box3 box{points[0], points[0]};
  for (const Vec3& p : points) box = united(box, {p, p});
  const Vec3 size = box.size();
  const double scale = ((1 << kBits) - 1) / std::max({size.x, size.y, size.z});
  const auto cell = [&](const Vec3& p, int axis) {
    const double c = (p[axis] - box.lo[axis]) * scale;
    return c > 0 ? static_cast<std::uint32_t>(c) : 0;  // NaN if all points are one
  };
  std::vector<std::uint64_t> keys;  // place on the curve, number
  keys.reserve(points.size());
  for (std::uint64_t n = 0; n < points.size(); ++n) {
    const Vec3& p = points[n];
    keys.push_back(hilbert_index(cell(p, 0), cell(p, 1), cell(p, 2), kBits) << 32 | n);
  }
  std::ranges::sort(keys);
  return {keys.begin(), keys.end()};  // the numbers are the low halves
}

class RunOfPoints {
 public:
  RunOfPoints(std::span<const Vec3> points, const TriangleTree& tree,
              std::span<NearestTriangle> found)
      : points_(points), tree_(tree), found_(found) {}

  void measure() {
    const std::vector<std::uint32_t> order = curve_order(points_);
    for (std::size_t n = 0; n < order.size(); n += kPatchPoints) {
      measure_patch(std::span(order).subspan(n, std::min(kPatchPoints, order.size() - n)));
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
    const Vec3 size = box.size();
    const double margin = kMargin * std::max({size.x, size.y, size.z});
    const Box3 around = box.grown(margin);
    candidates_.clear();
    std::size_t boxes_tested = 0, leaves = 0;
    tree_.for_each_leaf_near(box, margin, 0, boxes_tested, [&](std::size_t leaf, const Box3&) {
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
        if (candidate.triangle == near_) continue;
        if (!(distance2_to(candidate.box, p) < best.distance2)) continue;
        const double d = tree_.distance2(candidate.triangle, p);
        if (d < best.distance2) best = {candidate.triangle, d};
      }
      if (!all || best.distance2 > margin * margin) {
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
