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

  // Calls visit(f) for every triangle whose box meets `box`.
  template <class Visit>
  void for_each_meeting(const Box3& box, Visit&& visit) const {
    if (!order_.empty()) descend(0, 0, order_.size(), box, visit);
  }

  Box3 box_of(FaceId f) const;

 private:
  static constexpr std::size_t kLeaf = 4;

  static bool meet(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
           a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
  }

  template <class Visit>
  void descend(std::size_t node, std::size_t begin, std::size_t end, const Box3& box,
               Visit& visit) const {
    if (!meet(boxes_[node], box)) return;
    if (end - begin <= kLeaf) {
      for (std::size_t n = begin; n < end; ++n) {
        if (meet(box_of(order_[n]), box)) visit(order_[n]);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    descend(2 * node + 1, begin, middle, box, visit);
    descend(2 * node + 2, middle, end, box, visit);
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
