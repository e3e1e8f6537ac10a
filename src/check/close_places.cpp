// SPDX-License-Identifier: MIT
#include "check/close_places.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/triangle.h"

namespace deliso {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kVerticesPerTask = 1u << 12;
// Bound on the boxes compared for these vertices. A mesh needs some fifty for each. If very many
// triangles overlap, the rest of the task is given up.
constexpr std::size_t kMaxBoxesPerTask = 1u << 20;

// Returns a triangle without corner v that is no further from v than `near`; kNoId if there is
// none. Counts the boxes that it looks at, and gives up at kMaxBoxesPerTask.
FaceId triangle_near(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                     const TriangleTree& tree, VertexId v, double near, std::size_t& boxes) {
  FaceId found = kNoId;
  if (boxes > kMaxBoxesPerTask) return found;
  const Vec3& p = points[v];
  const Box3 around = Box3{p, p}.grown(near);
  tree.for_each_leaf_at(around, 0, boxes, [&](std::size_t leaf) {
    const std::span<const FaceId> here = tree.leaf(leaf);
    const std::span<const Box3> boxes_here = tree.boxes_of_leaf(leaf);
    for (std::size_t n = 0; n < here.size() && found == kNoId; ++n) {
      const FaceId f = here[n];
      if (!meet(boxes_here[n], around) || has_corner(triangles[f], v)) continue;
      if (tree.distance2(f, p) < near * near) found = f;
    }
    return found == kNoId && boxes <= kMaxBoxesPerTask;
  });
  return found;
}

class ClosePlaceSearch {
 public:
  ClosePlaceSearch(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                   const TriangleTree& tree, const Volume& volume, int threads)
      : points_(points), triangles_(triangles), tree_(tree), volume_(volume), threads_(threads) {
    for (const Triangle& t : triangles) {
      for (const VertexId v : t) is_open_[v] = 1;
    }
  }

  ClosePlaces run(std::span<const EdgeUse> uses) {
    find_needles();
    find_folds(uses);
    find_near();
    return std::move(found_);
  }

 private:
  const Vec3& corner(FaceId f, int n) const { return points_[triangles_[f][n]]; }
  Vec3 normal(FaceId f) const { return area_normal(corner(f, 0), corner(f, 1), corner(f, 2)); }

  void close_corners(FaceId f) {
    for (const VertexId v : triangles_[f]) is_open_[v] = 0;
  }

  void find_needles() {
    // The smallest angle is asin(1 / (2 r/l)).
    const double r_over_l = 1 / (2 * sine(kLeastAngle * kDegree)), most = r_over_l * r_over_l;
    for (FaceId f = 0; f < triangles_.size(); ++f) {
      is_needle_[f] = !(radius_ratio2(corner(f, 0), corner(f, 1), corner(f, 2)) <= most);
      if (!is_needle_[f]) continue;
      found_.needles.push_back(f);
      close_corners(f);
    }
  }

  void find_folds(std::span<const EdgeUse> uses) {
    const double most = -cosine(kLeastFold * kDegree);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() != 2 || edge[0].forward == edge[1].forward) return true;
      const FaceId f = edge[0].triangle, g = edge[1].triangle;
      if (is_needle_[f] || is_needle_[g]) return true;
      const Vec3 m = normal(f), n = normal(g);
      const double product = dot(m, n);
      if (product >= 0 || product * product < most * most * length2(m) * length2(n)) return true;
      if (faces_outwards(f, middle(f)) && faces_outwards(g, middle(g))) return true;
      found_.folds.emplace_back(std::min(f, g), std::max(f, g));
      return true;
    });
    for (const auto& [f, g] : found_.folds) {
      close_corners(f);
      close_corners(g);
    }
  }
  Vec3 middle(FaceId f) const { return (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3; }
  // True if g falls along the triangle's normal at p.
  bool faces_outwards(FaceId f, const Vec3& p) const {
    return dot(normal(f), volume_.gradient(p)) < 0;
  }

  void find_near() {
    const double near = near_distance(volume_);
    struct Work {
      std::vector<std::pair<VertexId, FaceId>> near;
      std::size_t given_up = 0;
    };
    std::vector<Work> works(runs_of(points_.size(), kVerticesPerTask));
    for_each_run(threads_, points_.size(), kVerticesPerTask,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   std::size_t boxes = 0;
                   for (std::size_t v = begin; v < end; ++v) {
                     if (!is_open_[v]) continue;
                     const FaceId f =
                         triangle_near(points_, triangles_, tree_, VertexId(v), near, boxes);
                     if (f != kNoId) works[run].near.emplace_back(v, f);
                     works[run].given_up += boxes > kMaxBoxesPerTask;
                   }
                 });
    for (const Work& work : works) {
      found_.near.insert(found_.near.end(), work.near.begin(), work.near.end());
      found_.given_up += work.given_up;
    }
  }
  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  const TriangleTree& tree_;
  const Volume& volume_;
  const int threads_;
  std::vector<std::uint8_t> is_needle_ = std::vector<std::uint8_t>(triangles_.size(), 0);
  // Per vertex: a corner of triangles, but of no needle or fold.
  std::vector<std::uint8_t> is_open_ = std::vector<std::uint8_t>(points_.size(), 0);
  ClosePlaces found_;
};

}  // namespace

bool has_triangle_near(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                       const TriangleTree& tree, VertexId v, double distance) {
  std::size_t boxes = 0;
  return triangle_near(points, triangles, tree, v, distance, boxes) != kNoId;
}

double near_distance(const Volume& volume) {
  const Vec3 size = volume.box().size();
  return kNearShare * std::max({size.x, size.y, size.z});
}

ClosePlaces find_close_places(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                              std::span<const EdgeUse> uses, const TriangleTree& tree,
                              const Volume& volume, int threads) {
  return ClosePlaceSearch(points, triangles, tree, volume, threads).run(uses);
}

}  // namespace deliso
