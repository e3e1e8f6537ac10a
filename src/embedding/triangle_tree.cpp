// SPDX-License-Identifier: MIT
#include "embedding/triangle_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace deliso {
namespace {

void extend(Box3& box, const Box3& by) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(box.lo[axis], by.lo[axis]);
    box.hi[axis] = std::max(box.hi[axis], by.hi[axis]);
  }
}

double distance2_to_box(const Vec3& p, const Box3& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double out = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
    sum += out * out;
  }
  return sum;
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vec3>& points, std::span<const Triangle> triangles)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
  if (triangles.empty()) return;
  std::iota(order_.begin(), order_.end(), FaceId{0});
  std::vector<Vec3> middles;
  middles.reserve(triangles.size());
  for (const Triangle& t : triangles) middles.push_back(points[t[0]] + points[t[1]] + points[t[2]]);
  std::size_t nodes = 1;  // halving rounds up: depth until the largest part is a leaf
  for (std::size_t part = triangles.size(); part > kLeaf; part -= part / 2) nodes = 2 * nodes + 1;
  boxes_.resize(nodes);
  build(0, 0, order_.size(), middles);
}

Box3 TriangleTree::box_of(FaceId f) const {
  const Triangle& t = triangles_[f];
  Box3 box{points_[t[0]], points_[t[0]]};
  extend(box, {points_[t[1]], points_[t[1]]});
  extend(box, {points_[t[2]], points_[t[2]]});
  return box;
}

void TriangleTree::build(std::size_t node, std::size_t begin, std::size_t end,
                         std::span<const Vec3> middles) {
  if (end - begin <= kLeaf) {
    boxes_[node] = box_of(order_[begin]);
    for (std::size_t n = begin + 1; n < end; ++n) extend(boxes_[node], box_of(order_[n]));
    return;
  }
  Box3 spread{middles[order_[begin]], middles[order_[begin]]};
  for (std::size_t n = begin; n < end; ++n)
    extend(spread, {middles[order_[n]], middles[order_[n]]});
  const Vec3 size = spread.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
  std::nth_element(at(begin), at(middle), at(end), [&](FaceId f, FaceId g) {
    return std::pair(middles[f][axis], f) < std::pair(middles[g][axis], g);
  });
  build(2 * node + 1, begin, middle, middles);
  build(2 * node + 2, middle, end, middles);
  boxes_[node] = boxes_[2 * node + 1];
  extend(boxes_[node], boxes_[2 * node + 2]);
}

NearestTriangle TriangleTree::nearest(const Vec3& p, double within2) const {
  NearestTriangle best{kNoId, within2};
  if (!order_.empty()) search(0, 0, order_.size(), p, best);
  return best;
}

void TriangleTree::search(std::size_t node, std::size_t begin, std::size_t end, const Vec3& p,
                          NearestTriangle& best) const {
  if (end - begin <= kLeaf) {
    for (std::size_t n = begin; n < end; ++n) {
      const Triangle& t = triangles_[order_[n]];
      const double d = distance2_to_triangle(p, points_[t[0]], points_[t[1]], points_[t[2]]);
      if (d < best.distance2) best = {order_[n], d};
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double left = distance2_to_box(p, boxes_[2 * node + 1]);
  const double right = distance2_to_box(p, boxes_[2 * node + 2]);
  const auto go_left = [&] {
    if (left < best.distance2) search(2 * node + 1, begin, middle, p, best);
  };
  const auto go_right = [&] {
    if (right < best.distance2) search(2 * node + 2, middle, end, p, best);
  };
  if (left <= right) {
    go_left();
    go_right();
  } else {
    go_right();
    go_left();
  }
}

}  // namespace deliso
