// SPDX-License-Identifier: MIT
// Axis-aligned closed boxes, and the clipping of lines against them (slab method).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "base/vec3.h"

namespace deliso {

// An interval of a line's parameter; empty when lo > hi.
struct Range {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool empty() const { return !(lo <= hi); }
};

struct Box3 {
  Vec3 lo, hi;

  bool contains(const Vec3& p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  Vec3 size() const { return hi - lo; }
  Vec3 middle() const { return 0.5 * (lo + hi); }
  Box3 grown(double by) const { return {lo - Vec3{by, by, by}, hi + Vec3{by, by, by}}; }
  double smallest_side() const { return std::min({size().x, size().y, size().z}); }
};

inline Box3 united(const Box3& a, const Box3& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

inline Box3 box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

// Returns the bounding box of the points. pre: there are some.
inline Box3 box_of(std::span<const Vec3> points) {
  Box3 box{points.front(), points.front()};
  for (const Vec3& p : points) box = united(box, {p, p});
  return box;
}

// True if the boxes have a common point.
inline bool meet(const Box3& a, const Box3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

// Returns the part of `range` in which origin + t * direction lies in the box.
inline Range clip(const Vec3& origin, const Vec3& direction, Range range, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = origin[axis], d = direction[axis];
    if (d == 0) {
      if (o < box.lo[axis] || o > box.hi[axis]) return {1, 0};
      continue;
    }
    double t0 = (box.lo[axis] - o) / d, t1 = (box.hi[axis] - o) / d;
    if (t0 > t1) std::swap(t0, t1);
    range.lo = std::max(range.lo, t0);
    range.hi = std::min(range.hi, t1);
  }
  return range;
}

// A face of a box: 2 * axis, + 1 at the high end.
using BoxFace = std::uint8_t;
constexpr int axis_of(BoxFace face) {
  return face >> 1;
}

// Returns the faces of `box` that are at most `tolerance` from p: bit n for face n.
inline unsigned box_faces_at(const Vec3& p, const Box3& box, double tolerance = 0) {
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(p[axis] - box.lo[axis]) <= tolerance) faces |= 1u << (2 * axis);
    if (std::fabs(p[axis] - box.hi[axis]) <= tolerance) faces |= 2u << (2 * axis);
  }
  return faces;
}

// Returns p moved into each of `faces`; nothing if two of them are opposite. Seen from such a
// point, a surface that ends in these faces bounds the volume that it bounds together with them.
inline std::optional<Vec3> moved_into_faces(Vec3 p, unsigned faces, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const unsigned ends = faces >> (2 * axis) & 3;
    if (ends == 3) return std::nullopt;
    if (ends != 0) p[axis] = (ends == 1 ? box.lo : box.hi)[axis];
  }
  return p;
}

// Returns the sum of the box's inward normals over `faces`.
inline Vec3 inwards(unsigned faces) {
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis) {
    if ((faces >> (2 * axis) & 1) != 0) sum[axis] += 1;
    if ((faces >> (2 * axis + 1) & 1) != 0) sum[axis] -= 1;
  }
  return sum;
}

// True if one face of `box` is at most `tolerance` from both p and q.
inline bool on_one_face(const Vec3& p, const Vec3& q, const Box3& box, double tolerance = 0) {
  return (box_faces_at(p, box, tolerance) & box_faces_at(q, box, tolerance)) != 0;
}

}  // namespace deliso
