// SPDX-License-Identifier: MIT
// A binary tree of boxes that finds triangles by place. Leaves have four triangles. Nodes are
// halved at the median along the longest side of the box of the triangles' middles. The tree is in
// one array, with the children of n at 2n + 1 and 2n + 2.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "base/box3.h"
#include "base/triangle.h"
#include "mesh/tri_mesh.h"

namespace deliso {

struct NearestTriangle {
  FaceId triangle = kNoId;
  double distance2 = std::numeric_limits<double>::infinity();
};

// The squared distance of a point whose search was given up.
inline constexpr double kGivenUp = -1;

class TriangleTree {
 public:
  // Keeps references: both must outlive the tree. The tree is the same for any number of
  // threads.
  TriangleTree(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
               int threads = 1);

  // pre: there are triangles.
  const Box3& box() const { return boxes_[0]; }
  std::size_t leaf_count() const { return (order_.size() + kLeafTriangles - 1) / kLeafTriangles; }
  std::span<const FaceId> leaf(std::size_t n) const {
    return std::span(order_).subspan(n * kLeafTriangles,
                                     std::min(kLeafTriangles, order_.size() - n * kLeafTriangles));
  }
  // Returns the boxes of the leaf's triangles.
  std::span<const Box3> boxes_of_leaf(std::size_t n) const {
    return std::span(triangle_boxes_).subspan(n * kLeafTriangles, leaf(n).size());
  }

  // Returns the triangle nearest to p, or `best` if none is nearer.
  NearestTriangle nearest(const Vec3& p, NearestTriangle best = {}) const {
    std::size_t leaves_left = leaf_count() + 1;
    search(p, best, leaves_left);
    return best;
  }
  // Returns the nearest triangle of each point; kNoId if there are no triangles. A point whose
  // search was given up has the distance kGivenUp. The result is the same for any number of
  // threads.
  std::vector<NearestTriangle> nearest(std::span<const Vec3> points, int threads) const;

  double distance2(FaceId f, const Vec3& p) const {
    const Triangle& t = triangles_[f];
    return distance2_to_triangle(p, points_[t[0]], points_[t[1]], points_[t[2]]);
  }

  // Calls visit(leaf) for every leaf from number `first` on whose box meets `box`. Goes in the
  // order of leaf numbers, until visit returns false. Each box tested adds one to `boxes_tested`.
  template <class Visit>
  void for_each_leaf_at(const Box3& box, std::size_t first, std::size_t& boxes_tested,
                        Visit&& visit) const {
    Subtree stack[kMaxDepth];
    std::size_t size = 0;
    if (!order_.empty()) stack[size++] = {0, 0, leaf_count()};
    while (size > 0) {
      const Subtree part = stack[--size];
      if (part.end <= first || (++boxes_tested, !meet(boxes_[part.node], box))) continue;
      if (part.is_leaf()) {
        if (!visit(part.begin)) break;
      } else {
        stack[size++] = part.right();
        stack[size++] = part.left();
      }
    }
  }

 private:
  static constexpr std::size_t kLeafTriangles = 4;
  static constexpr std::size_t kMaxDepth = 64;  // more than any tree has

  // A node and the leaves under it.
  struct Subtree {
    std::size_t node, begin, end;
    bool is_leaf() const { return end - begin == 1; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Subtree left() const { return {2 * node + 1, begin, middle()}; }
    Subtree right() const { return {2 * node + 2, middle(), end}; }
  };
  struct Item;

  // Sets `best` to f if f is nearer.
  void lower(NearestTriangle& best, FaceId f, const Vec3& p) const {
    const double d = distance2(f, p);
    if (d < best.distance2) best = {f, d};
  }
  void split(const Subtree& part, std::span<Item> items);
  void build(const Subtree& part, std::span<Item> items);
  // Lowers `found`, of each point, to the nearest triangles within `margin`. Returns false if there
  // is too much to look at; then some are not the nearest.
  bool search_near(std::span<const Vec3> points, double margin,
                   std::span<NearestTriangle> found) const;
  double mean_size() const;  // of the triangles' boxes, along their longest side
  // Lowers `best`. Each leaf visited subtracts one from `leaves_left`; at 0 the search ends.
  void search(const Vec3& p, NearestTriangle& best, std::size_t& leaves_left) const {
    if (!order_.empty()) search({0, 0, leaf_count()}, p, best, leaves_left);
  }
  void search(const Subtree& part, const Vec3& p, NearestTriangle& best,
              std::size_t& leaves_left) const;

  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  std::vector<FaceId> order_;
  std::vector<Box3> triangle_boxes_;  // in this order
  std::vector<Box3> boxes_;           // of the nodes
};

}  // namespace deliso
