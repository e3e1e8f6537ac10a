// SPDX-License-Identifier: MIT
#include "embedding/triangle_pair.h"

#include <algorithm>

#include "base/box3.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// Orientation within the plane of a triangle, which counts as counter-clockwise.
class PlaneOf {
 public:
  PlaneOf(const Vec3& a, const Vec3& b, const Vec3& c) : apex_(a) {
    // Along some axis a step leaves the plane. It is as long as the triangle is large, so that
    // rounding does not swallow it.
    const double size = std::max({predicates::largest(b.x - a.x, b.y - a.y, b.z - a.z),
                                  predicates::largest(c.x - a.x, c.y - a.y, c.z - a.z),
                                  predicates::largest(a.x, a.y, a.z)});
    for (int axis = 0; axis < 3; ++axis) {
      apex_ = a;
      apex_[axis] += size;
      sign_ = orient3d(a, b, c, apex_);
      if (sign_ != 0) return;
    }
  }

  // pre: p, q, r lie in the plane.
  int turn(const Vec3& p, const Vec3& q, const Vec3& r) const {
    return sign_ * orient3d(p, q, r, apex_);
  }

  // True if they meet and are not on one line.
  bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) const {
    const int pqa = turn(p, q, a), pqb = turn(p, q, b);
    return (pqa != 0 || pqb != 0) && pqa * pqb <= 0 && turn(a, b, p) * turn(a, b, q) <= 0;
  }

  bool inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) const {
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  }

 private:
  Vec3 apex_;
  int sign_ = 0;
};

// True if the closed segment pq and the closed triangle abc have a point in common.
// pre: a, b, c are not collinear.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                            const Vec3& c) {
  const int p_side = orient3d(a, b, c, p), q_side = orient3d(a, b, c, q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) {
    // Where pq meets a side on its line and p is outside, it meets the next side in their corner.
    const PlaneOf plane(a, b, c);
    return plane.inside(p, a, b, c) || plane.segments_meet(p, q, a, b) ||
           plane.segments_meet(p, q, b, c) || plane.segments_meet(p, q, c, a);
  }
  // The line passes through the plane in one point, which is on the segment.
  const int ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c);
  if (ab * bc < 0) return false;
  const int ca = orient3d(p, q, c, a);
  return ab * ca >= 0 && bc * ca >= 0;
}

}  // namespace

bool is_separated(const std::vector<Vec3>& points, const Triangle& s, const Vec3& normal,
                  const Triangle& t) {
  constexpr double kSeparation = 1e-10;  // a share of the size of the compared terms
  for (const int side : {2, 0, 1}) {
    const VertexId from = s[(side + 1) % 3], to = s[(side + 2) % 3];
    const Vec3 outwards = cross(points[to] - points[from], normal);
    const double margin = kSeparation * sum_of_sizes(outwards);
    const auto is_beyond = [&](VertexId v, double sign) {
      const Vec3 w = points[v] - points[from];
      return sign * dot(outwards, w) > margin * sum_of_sizes(w);
    };
    if (std::ranges::all_of(t,
                            [&](VertexId v) { return v == from || v == to || is_beyond(v, 1); }) &&
        is_beyond(s[side], -1)) {
      return true;
    }
  }
  return false;
}

bool triangles_intersect(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t) {
  // Permuted so that shared vertices come first in both.
  Triangle u = s, v = t;
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = shared; j < 3; ++j) {
      if (v[j] != s[i]) continue;
      std::swap(v[j], v[shared]);
      std::swap(*std::find(u.begin(), u.end(), s[i]), u[shared]);
      ++shared;
      break;
    }
  }
  const Vec3 &a = points[u[0]], &b = points[u[1]], &c = points[u[2]];
  const Vec3 &d = points[v[0]], &e = points[v[1]], &f = points[v[2]];
  switch (shared) {
    case 3:
      return true;
    case 2: {  // an edge: they meet elsewhere only if one is folded onto the other
      return orient3d(a, b, c, f) == 0 && PlaneOf(a, b, c).turn(a, b, f) > 0;
    }
    case 1:  // Two convex sets that meet in a and elsewhere meet along a segment from a. It ends on
             // the far side of one of them. A set on one side of the other's plane meets it in a.
      return (meet(box_of(b, c, c), box_of(d, e, f)) || meet(box_of(e, f, f), box_of(a, b, c))) &&
             orient3d(d, e, f, b) * orient3d(d, e, f, c) <= 0 &&
             orient3d(a, b, c, e) * orient3d(a, b, c, f) <= 0 &&
             (segment_meets_triangle(b, c, d, e, f) || segment_meets_triangle(e, f, a, b, c));
    default:
      break;
  }
  // One of the planes separates most pairs.
  const int d_side = orient3d(a, b, c, d);
  if (d_side != 0 && d_side == orient3d(a, b, c, e) && d_side == orient3d(a, b, c, f)) return false;
  const int a_side = orient3d(d, e, f, a);
  if (a_side != 0 && a_side == orient3d(d, e, f, b) && a_side == orient3d(d, e, f, c)) return false;
  // If two triangles meet, an edge of one meets the other.
  return segment_meets_triangle(a, b, d, e, f) || segment_meets_triangle(b, c, d, e, f) ||
         segment_meets_triangle(c, a, d, e, f) || segment_meets_triangle(d, e, a, b, c) ||
         segment_meets_triangle(e, f, a, b, c) || segment_meets_triangle(f, d, a, b, c);
}

}  // namespace deliso
