// SPDX-License-Identifier: MIT
#include "check/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "check/point_grid.h"

namespace deliso {
namespace {

constexpr std::size_t kTaskLeaves = 1u << 13;  // of a subtree built in one task
constexpr std::size_t kPointsPerTask = 1u << 14;
// Bound on the leaves visited for these points. A mesh has about five near a point. If very many
// overlap, the rest of the task is given up.
constexpr std::size_t kMaxLeavesPerTask = 1u << 20;

// In mean sizes of a triangle. Nearly all points of Sigma are so near to the mesh. They are found
// from the triangles, which look for points around them.
constexpr double kMarginSizes = 0.125;
constexpr double kCellMargins = 10;  // side of a cell of points, in margins
// Bound on the points looked at for triangles. Each is looked at about thirty times.
constexpr std::size_t kMaxLooksPerTask = 1u << 23;

// Returns the squared distance from p to the box; 0 inside.
double distance2_to(const Box3& box, const Vec3& p) {
  return length2(p - Vec3{std::clamp(p.x, box.lo.x, box.hi.x), std::clamp(p.y, box.lo.y, box.hi.y),
                          std::clamp(p.z, box.lo.z, box.hi.z)});
}

}  // namespace

// Moved as a whole, since looking it up by its id waits for memory.
struct TriangleTree::Item {
  Vec3 middle;
  FaceId triangle;
};

TriangleTree::TriangleTree(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                           int threads)
    : points_(points), triangles_(triangles) {
  if (triangles.empty()) return;
  std::vector<Item> items(triangles.size());
  for (FaceId f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    items[f] = {points[t[0]] + points[t[1]] + points[t[2]], f};
  }
  order_.resize(triangles.size());
  triangle_boxes_.resize(triangles.size());
  std::size_t nodes = 1;  // halving rounds up: depth until the largest part is a leaf
  for (std::size_t part = leaf_count(); part > 1; part -= part / 2) nodes = 2 * nodes + 1;
  boxes_.resize(nodes);

  // Splits level by level down to the subtrees that are tasks, builds these, then the boxes above
  // them.
  std::vector<Subtree> above, tasks{{0, 0, leaf_count()}};
  while (tasks.front().end - tasks.front().begin > kTaskLeaves) {
    std::vector<Subtree> halves;
    for (const Subtree& part : tasks) halves.insert(halves.end(), {part.left(), part.right()});
    for_each_task(threads, tasks.size(), [&](std::size_t n) { split(tasks[n], items); });
    above.insert(above.end(), tasks.begin(), tasks.end());
    tasks = std::move(halves);
  }
  for_each_task(threads, tasks.size(), [&](std::size_t n) { build(tasks[n], items); });
  std::reverse(above.begin(), above.end());
  for (const Subtree& part : above) {
    boxes_[part.node] = united(boxes_[2 * part.node + 1], boxes_[2 * part.node + 2]);
  }
}

void TriangleTree::split(const Subtree& part, std::span<Item> items) {
  const auto at = [&](std::size_t leaf) {
    return items.begin() +
           static_cast<std::ptrdiff_t>(std::min(leaf * kLeafTriangles, items.size()));
  };
  Box3 spread{at(part.begin)->middle, at(part.begin)->middle};
  for (auto item = at(part.begin); item != at(part.end); ++item) {
    spread = united(spread, {item->middle, item->middle});
  }
  const Vec3 size = spread.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(at(part.begin), at(part.middle()), at(part.end),
                   [axis](const Item& a, const Item& b) {
                     const double s = a.middle[axis], t = b.middle[axis];
                     return s < t || (s == t && a.triangle < b.triangle);
                   });
}

void TriangleTree::build(const Subtree& part, std::span<Item> items) {
  if (part.is_leaf()) {
    const std::size_t begin = part.begin * kLeafTriangles,
                      end = std::min(begin + kLeafTriangles, items.size());
    // nth_element leaves an order of its own in every standard library.
    std::ranges::sort(items.subspan(begin, end - begin), {}, &Item::triangle);
    for (std::size_t n = begin; n < end; ++n) {
      order_[n] = items[n].triangle;
      const Triangle& t = triangles_[order_[n]];
      triangle_boxes_[n] = box_of(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    boxes_[part.node] = triangle_boxes_[begin];
    for (std::size_t n = begin + 1; n < end; ++n) {
      boxes_[part.node] = united(boxes_[part.node], triangle_boxes_[n]);
    }
    return;
  }
  split(part, items);
  build(part.left(), items);
  build(part.right(), items);
  boxes_[part.node] = united(boxes_[2 * part.node + 1], boxes_[2 * part.node + 2]);
}

double TriangleTree::mean_size() const {
  double sum = 0;
  for (const Box3& box : triangle_boxes_) {
    const Vec3 size = box.size();
    sum += std::max({size.x, size.y, size.z});
  }
  return sum / static_cast<double>(triangle_boxes_.size());
}

bool TriangleTree::search_near(std::span<const Vec3> points, double margin,
                               std::span<NearestTriangle> found) const {
  Box3 around{points[0], points[0]};
  std::vector<NumberedPoint> numbered;
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    numbered.push_back({points[n], n});
    around = united(around, {points[n], points[n]});
  }
  const PointGrid grid(numbered, kCellMargins * margin);
  std::size_t boxes_tested = 0, looked_at = 0;
  for_each_leaf_at(around.grown(margin), 0, boxes_tested, [&](std::size_t n) {
    for (std::size_t k = 0; k < leaf(n).size(); ++k) {
      const FaceId f = leaf(n)[k];
      const Box3 box = boxes_of_leaf(n)[k].grown(margin);
      grid.for_each_near(box, looked_at, [&](const NumberedPoint& p) {
        if (box.contains(p.at)) lower(found[p.number], f, p.at);
        return looked_at < kMaxLooksPerTask;
      });
    }
    return looked_at < kMaxLooksPerTask;
  });
  return looked_at < kMaxLooksPerTask;
}

std::vector<NearestTriangle> TriangleTree::nearest(std::span<const Vec3> points,
                                                   int threads) const {
  std::vector<NearestTriangle> found(points.size());
  if (order_.empty()) return found;
  const double margin = kMarginSizes * mean_size();
  for_each_run(threads, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    const std::size_t size = end - begin;
    const bool is_complete =
        search_near(points.subspan(begin, size), margin, std::span(found).subspan(begin, size));
    std::size_t leaves_left = kMaxLeavesPerTask;
    FaceId near = 0;  // of the last point searched, which is near the next one
    for (std::size_t n = begin; n < end; ++n) {
      if (is_complete && found[n].distance2 <= margin * margin) continue;
      lower(found[n], near, points[n]);
      search(points[n], found[n], leaves_left);
      near = found[n].triangle;
      if (leaves_left == 0) found[n].distance2 = kGivenUp;
    }
  });
  return found;
}

void TriangleTree::search(const Subtree& part, const Vec3& p, NearestTriangle& best,
                          std::size_t& leaves_left) const {
  if (leaves_left == 0) return;
  if (part.is_leaf()) {
    --leaves_left;
    for (const FaceId f : leaf(part.begin)) lower(best, f, p);
    return;
  }
  const double left = distance2_to(boxes_[2 * part.node + 1], p);
  const double right = distance2_to(boxes_[2 * part.node + 2], p);
  const auto go_left = [&] {
    if (left < best.distance2) search(part.left(), p, best, leaves_left);
  };
  const auto go_right = [&] {
    if (right < best.distance2) search(part.right(), p, best, leaves_left);
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
