// SPDX-License-Identifier: MIT
// Triangles found by place: a binary tree of boxes, halved at the median along the longest side of
// the box of the triangles' middles, in one array (children of n at 2n + 1 and 2n + 2).
#pragma once

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
  // Keeps references: both must outlive it.
  TriangleTree(const std::vector<Vec3>& points, std::span<const Triangle> triangles);

  // The triangle nearest to p, nearer than the square root of `within2`; kNoId when there is none.
  NearestTriangle nearest(const Vec3& p,
                          double within2 = std::numeric_limits<double>::infinity()) const;

  // Calls visit(f, g) once for every two triangles whose boxes meet.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    std::vector<Box3> boxes(order_.size());
    for (std::size_t n = 0; n < order_.size(); ++n) boxes[n] = box_of(order_[n]);
    const auto visit_numbers = [&](std::size_t m, std::size_t n) {
      if (meet(boxes[m], boxes[n])) visit(order_[m], order_[n]);
    };
    if (!order_.empty()) pair_up({0, 0, order_.size()}, visit_numbers);
  }

  Box3 box_of(FaceId f) const;

 private:
  // A node and the triangles under it, order_[begin .. end).
  struct Part {
    std::size_t node, begin, end;
    bool is_leaf() const { return end - begin <= kLeaf; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Part left() const { return {2 * node + 1, begin, middle()}; }
    Part right() const { return {2 * node + 2, middle(), end}; }
  };

  // The pairs within a part.
  template <class Visit>
  void pair_up(const Part& part, Visit& visit) const {
    if (part.is_leaf()) {
      for (std::size_t m = part.begin; m < part.end; ++m) {
        for (std::size_t n = m + 1; n < part.end; ++n) visit(m, n);
      }
      return;
    }
    pair_up(part.left(), visit);
    pair_up(part.right(), visit);
    pair_up(part.left(), part.right(), visit);
  }

  // The pairs of one triangle from each.
  template <class Visit>
  void pair_up(const Part& a, const Part& b, Visit& visit) const {
    if (!meet(boxes_[a.node], boxes_[b.node])) return;
    if (a.is_leaf() && b.is_leaf()) {
      for (std::size_t m = a.begin; m < a.end; ++m) {
        for (std::size_t n = b.begin; n < b.end; ++n) visit(m, n);
      }
    } else if (b.is_leaf() || (!a.is_leaf() && a.end - a.begin >= b.end - b.begin)) {
      pair_up(a.left(), b, visit);
      pair_up(a.right(), b, visit);
    } else {
      pair_up(a, b.left(), visit);
      pair_up(a, b.right(), visit);
    }
  }

  static constexpr std::size_t kLeaf = 4;

  static bool meet(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
           a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
  }

  void build(std::size_t node, std::size_t begin, std::size_t end, std::span<const Vec3> middles);
  void search(std::size_t node, std::size_t begin, std::size_t end, const Vec3& p,
              NearestTriangle& best) const;

  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  std::vector<FaceId> order_;
  std::vector<Box3> boxes_;
};

}  // namespace deliso
