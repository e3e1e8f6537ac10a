// SPDX-License-Identifier: MIT
#include "embedding/disk_crossing.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"

namespace deliso {
namespace {

// A share of the size of the compared terms, far above rounding.
constexpr double kMargin = 1e-10;

double size_of(const Vec3& v) {
  return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
}

}  // namespace

bool DiskCrossing::begin(const std::vector<Vec3>& points, const Disk& disk,
                         std::span<const Vec3> normals, const BoxGrid& grid) {
  points_ = &points;
  disk_ = &disk;
  normals_ = normals;
  boxes_.clear();
  for (const Triangle& t : disk.facets) {
    if (collinear(point(t[0]), point(t[1]), point(t[2]))) return false;
    boxes_.push_back(grid.box_of(points, t));
  }
  planes_.clear();
  ++stamp_;
  known_.resize(points.size());
  for (const Disk::BoundaryEdge& edge : disk.boundary) {
    const Plane plane = plane_through(disk.facets[edge.facet], normals_[edge.facet], edge.side);
    const auto is_inside = [&](VertexId v) {
      return v == plane.from || v == plane.to || is_on_side(plane, v, -1);
    };
    if (planes_.size() < kMaxPlanes && std::ranges::all_of(disk.vertices(), is_inside)) {
      planes_.push_back(plane);
    }
  }
  // The disk's own vertices are inside, but for the ends of a plane's side.
  for (const VertexId v : disk.vertices()) known_[v] = {stamp_, 0};
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    known_[planes_[n].from].planes |= std::uint32_t{1} << n;
    known_[planes_[n].to].planes |= std::uint32_t{1} << n;
  }
  return true;
}

BoxGrid::Box DiskCrossing::box() const {
  BoxGrid::Box all = boxes_[0];
  for (const BoxGrid::Box& box : boxes_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.lo[axis] = std::min(all.lo[axis], box.lo[axis]);
      all.hi[axis] = std::max(all.hi[axis], box.hi[axis]);
    }
  }
  return all;
}

bool DiskCrossing::crosses_itself(VertexId apex) const {
  if (apex != kNoId && is_fan(apex)) return false;
  const std::vector<Triangle>& facets = disk_->facets;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t g = f + 1; g < facets.size(); ++g) {
      if (BoxGrid::meet(boxes_[f], boxes_[g]) && meet(f, facets[g])) return true;
    }
  }
  return false;
}

bool DiskCrossing::crosses(const Triangle& t, const BoxGrid::Box& box) {
  if ((planes_with_outside(t[0]) & planes_with_outside(t[1]) & planes_with_outside(t[2])) != 0)
    return false;
  for (std::size_t f = 0; f < boxes_.size(); ++f) {
    if (BoxGrid::meet(boxes_[f], box) && meet(f, t)) return true;
  }
  return false;
}

// True if the facets lie side by side around their apex. That is tested along the mean of their
// normals, by more than rounding. Each facet runs around the apex in the same direction, and all of
// them together once.
bool DiskCrossing::is_fan(VertexId apex) const {
  const std::vector<Triangle>& facets = disk_->facets;
  const Vec3& center = point(apex);
  Vec3 along;
  double longest2 = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f][2] != apex) return false;
    along = along + normals_[f];
    longest2 = std::max(longest2, distance2(point(facets[f][0]), center));
  }
  const double margin = kMargin * longest2 * size_of(along);
  const VertexId first = facets[0][0];
  const Vec3 across = cross(along, point(first) - center);
  int rounds = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (!(dot(normals_[f], along) > margin)) return false;
    const double from = facets[f][0] == first ? 0 : dot(across, point(facets[f][0]) - center);
    const double to = facets[f][1] == first ? 0 : dot(across, point(facets[f][1]) - center);
    if (facets[f][0] != first && !(std::fabs(from) > margin)) return false;
    rounds += from < 0 && to >= 0;
  }
  return rounds == 1;
}

std::uint32_t DiskCrossing::planes_with_outside(VertexId v) {
  Known& known = known_[v];
  if (known.stamp == stamp_) return known.planes;
  known = {stamp_, 0};
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    const Plane& plane = planes_[n];
    const bool is_outside = v == plane.from || v == plane.to || is_on_side(plane, v, 1);
    known.planes |= static_cast<std::uint32_t>(is_outside) << n;
  }
  return known.planes;
}

DiskCrossing::Plane DiskCrossing::plane_through(const Triangle& t, const Vec3& normal,
                                                int side) const {
  const VertexId from = t[(side + 1) % 3], to = t[(side + 2) % 3];
  const Vec3& origin = point(from);
  const Vec3 outwards = cross(point(to) - origin, normal);
  return {from, to, origin, outwards, kMargin * size_of(outwards)};
}

bool DiskCrossing::is_on_side(const Plane& plane, VertexId v, double sign) const {
  const Vec3 w = point(v) - plane.origin;
  return sign * dot(plane.outwards, w) > plane.margin * size_of(w);
}

inline bool DiskCrossing::separates(const Plane& plane, VertexId inside,
                                    const Triangle& other) const {
  const auto is_outside = [&](VertexId v) {
    return v == plane.from || v == plane.to || is_on_side(plane, v, 1);
  };
  return std::ranges::all_of(other, is_outside) && is_on_side(plane, inside, -1);
}

bool DiskCrossing::meet(std::size_t f, const Triangle& t) const {
  const Triangle& s = disk_->facets[f];
  // Side 2 first: a cone has it on the boundary.
  for (const int side : {2, 0, 1}) {
    const auto inside = s[static_cast<std::size_t>(side)];
    if (separates(plane_through(s, normals_[f], side), inside, t)) return false;
  }
  const Vec3 &a = point(t[0]), &b = point(t[1]), &c = point(t[2]);
  const Vec3 normal = area_normal(a, b, c);
  for (int side = 0; side < 3; ++side) {
    const auto inside = t[static_cast<std::size_t>(side)];
    if (separates(plane_through(t, normal, side), inside, s)) return false;
  }
  return !collinear(a, b, c) && triangles_intersect(*points_, s, t);
}

}  // namespace deliso
