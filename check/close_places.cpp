// SPDX-License-Identifier: MIT
#include "check/close_places.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/sorted_list.h"
#include "base/triangle.h"

namespace deliso {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kTrianglesAtATime = 1u << 12;
// Bound on the vertices looked at for these triangles. A mesh needs some thirty for each. If very
// many lie around them, the rest is given up.
constexpr std::size_t kMaxLooksAtATime = 1u << 22;
constexpr std::size_t kMaxBoxesOfVertex = 1u << 20;

class ClosePlaceSearch {
 public:
  ClosePlaceSearch(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                   const VertexGrids& grids, const VolumeSource& field, int threads)
      : points_(points), triangles_(triangles), grids_(grids), field_(field), threads_(threads) {
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
    return dot(normal(f), gradient_at(field_, p)) < 0;
  }

  // Each triangle looks for vertices around it. Of several at a vertex the first is reported.
  void find_near() {
    const double near = near_distance(field_.shape);
    struct Work {
      std::vector<std::pair<VertexId, FaceId>> near;
      std::size_t given_up = 0;
    };
    std::vector<Work> works(runs_of(triangles_.size(), kTrianglesAtATime));
    for_each_run(threads_, triangles_.size(), kTrianglesAtATime,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   std::size_t looked_at = 0;
                   for (auto f = FaceId(begin); f < end; ++f) {
                     const Vec3 &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
                     const Box3 box = box_of(a, b, c).grown(near);
                     grids_.for_each_near(box, looked_at, [&](const NumberedPoint& p) {
                       const VertexId v(p.number);
                       if (is_open_[v] != 0 && box.contains(p.at) &&
                           !has_corner(triangles_[f], v) &&
                           distance2_to_triangle(p.at, a, b, c) < near * near) {
                         works[run].near.emplace_back(v, f);
                       }
                       return looked_at < kMaxLooksAtATime;
                     });
                     works[run].given_up += looked_at >= kMaxLooksAtATime;
                   }
                 });
    for (const Work& work : works) {
      found_.near.insert(found_.near.end(), work.near.begin(), work.near.end());
      found_.given_up += work.given_up;
    }
    std::ranges::sort(found_.near);
    const auto of_one_vertex = [](const auto& s, const auto& t) { return s.first == t.first; };
    const auto end = std::unique(found_.near.begin(), found_.near.end(), of_one_vertex);
    found_.near.erase(end, found_.near.end());
  }
  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  const VertexGrids& grids_;
  const VolumeSource& field_;
  const int threads_;
  std::vector<std::uint8_t> is_needle_ = std::vector<std::uint8_t>(triangles_.size(), 0);
  // Per vertex: a corner of triangles, but of no needle or fold.
  std::vector<std::uint8_t> is_open_ = std::vector<std::uint8_t>(points_.size(), 0);
  ClosePlaces found_;
};

}  // namespace

bool has_triangle_near(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                       const TriangleTree& tree, VertexId v, double distance) {
  bool found = false;
  std::size_t boxes = 0;
  const Vec3& p = points[v];
  const Box3 around = Box3{p, p}.grown(distance);
  tree.for_each_leaf_at(around, 0, boxes, [&](std::size_t leaf) {
    found = std::ranges::any_of(tree.leaf(leaf), [&](FaceId f) {
      return !has_corner(triangles[f], v) && tree.distance2(f, p) < distance * distance;
    });
    return !found && boxes <= kMaxBoxesOfVertex;
  });
  return found;
}

double near_distance(const Grid& volume) {
  return kNearVoxels * volume.least_voxel();
}

ClosePlaces find_close_places(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                              std::span<const EdgeUse> uses, const VertexGrids& grids,
                              const VolumeSource& field, int threads) {
  return ClosePlaceSearch(points, triangles, grids, field, threads).run(uses);
}

std::size_t count_at_caps(const ClosePlaces& found, std::span<const Triangle> triangles,
                          const std::vector<bool>& is_cap) {
  std::vector<VertexId> of_surface;
  for (FaceId f = 0; f < triangles.size(); ++f) {
    if (!is_cap[f]) of_surface.insert(of_surface.end(), triangles[f].begin(), triangles[f].end());
  }
  sort_unique(of_surface);
  const auto is_of_cap = [&](FaceId f) { return bool{is_cap[f]}; };
  return static_cast<std::size_t>(
      std::ranges::count_if(found.needles, is_of_cap) +
      std::ranges::count_if(
          found.folds,
          [&](const auto& fold) { return is_cap[fold.first] || is_cap[fold.second]; }) +
      std::ranges::count_if(found.near, [&](const auto& near) {
        return is_cap[near.second] || !std::ranges::binary_search(of_surface, near.first);
      }));
}

}  // namespace deliso
