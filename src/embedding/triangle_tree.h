// SPDX-License-Identifier: MIT
// Triangles found by place: a binary tree of boxes over leaves of four triangles, halved at the
// median along the longest side of the box of the triangles' middles, in one array (children of n
// at 2n + 1 and 2n + 2).
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

class TriangleTree {
 public:
  // Keeps references: both must outlive it. The triangles' boxes are grown by `slack`. The tree is
  // the same with any number of threads.
  TriangleTree(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
               int threads = 1, double slack = 0);

  // pre: there are triangles.
  const Box3& box() const { return boxes_[0]; }
  std::size_t leaf_count() const { return (order_.size() + kLeaf - 1) / kLeaf; }
  std::span<const FaceId> leaf(std::size_t n) const {
    return std::span(order_).subspan(n * kLeaf, std::min(kLeaf, order_.size() - n * kLeaf));
  }
  // The boxes of its triangles.
  std::span<const Box3> boxes_of_leaf(std::size_t n) const {
    return std::span(triangle_boxes_).subspan(n * kLeaf, leaf(n).size());
  }

  // The triangle nearest to p, nearer than the square root of `within2`; kNoId when there is none.
  // Each leaf that is looked at takes one from `leaves_left`; at 0 it ends, with what it has.
  NearestTriangle nearest(const Vec3& p, double within2 = std::numeric_limits<double>::infinity(),
                          std::size_t* leaves_left = nullptr) const;

  double distance2(FaceId f, const Vec3& p) const {
    const Triangle& t = triangles_[f];
    return distance2_to_triangle(p, points_[t[0]], points_[t[1]], points_[t[2]]);
  }
  // Sets `best` to the triangle of a leaf that is nearest to p, where it is nearer.
  void improve(std::size_t leaf_number, const Vec3& p, NearestTriangle& best) const {
    const std::span<const FaceId> faces = leaf(leaf_number);
    const std::span<const Box3> boxes = boxes_of_leaf(leaf_number);
    for (std::size_t n = 0; n < faces.size(); ++n) {
      if (!(distance2_to(boxes[n], p) < best.distance2)) continue;
      const double d = distance2(faces[n], p);
      if (d < best.distance2) best = {faces[n], d};
    }
  }

  // Calls visit(leaf, its box) for every leaf from number `first` on whose box is no further than
  // `within` from `box` along each axis, in the order of their numbers, until it returns false.
  // Each box that is looked at adds one to `looked`.
  template <class Visit>
  void for_each_leaf_near(const Box3& box, double within, std::size_t first, std::size_t& looked,
                          Visit&& visit) const {
    Part stack[kDepth];
    std::size_t size = 0;
    if (!order_.empty()) stack[size++] = {0, 0, leaf_count()};
    const Box3 grown = box.grown(within);
    while (size > 0) {
      const Part part = stack[--size];
      if (part.end <= first || (++looked, !meet(boxes_[part.node], grown))) continue;
      if (part.is_leaf()) {
        if (!visit(part.begin, boxes_[part.node])) break;
      } else {
        stack[size++] = part.right();
        stack[size++] = part.left();
      }
    }
  }

  static bool meet(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
           a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
  }

 private:
  static constexpr std::size_t kLeaf = 4;
  static constexpr std::size_t kDepth = 64;  // of the tree, with room to spare

  // A node and the leaves under it.
  struct Part {
    std::size_t node, begin, end;
    bool is_leaf() const { return end - begin == 1; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Part left() const { return {2 * node + 1, begin, middle()}; }
    Part right() const { return {2 * node + 2, middle(), end}; }
  };
  struct Item;

  void split(const Part& part, std::span<Item> items);
  void build(const Part& part, std::span<Item> items);
  void search(const Part& part, const Vec3& p, NearestTriangle& best,
              std::size_t& leaves_left) const;

  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  double slack_;
  std::vector<FaceId> order_;
  std::vector<Box3> triangle_boxes_;  // in this order
  std::vector<Box3> boxes_;           // of the nodes
};

}  // namespace deliso
