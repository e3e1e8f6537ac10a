// SPDX-License-Identifier: MIT
#include "embedding/disk_crossing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/triangle.h"
#include "embedding/triangle_pair.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// A share of the size of the compared terms, far above rounding.
constexpr double kMargin = 1e-10;

// The same in single precision: what passes it passes kMargin in double. For a plane with a normal
// of size 1, through a point f, and a point p, both relative to the center, rounding to single
// precision and single products change the distance by less than 2^-21 (|p| + |f|). So it exceeds
// 2^-20 (|p| + |f|), and |p - f| is no more than that sum.
constexpr float kSingleMargin = 0x1p-19f;
// More than what underflow takes away: the disk's size is about 1.
constexpr float kUnderflow = 0x1p-100f;

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
  set_planes();
  return true;
}

void DiskCrossing::set_planes() {
  const std::span<const VertexId> vertices = disk_->vertices();
  const std::size_t count = std::min(disk_->boundary.size(), kMaxPlanes);
  ++stamp_;
  known_.resize(points_->size());
  for (const VertexId v : vertices) known_[v] = {stamp_, 0};
  center_ = point(vertices[0]);
  double size = 0;
  for (const VertexId v : vertices) size = std::max(size, sum_of_sizes(point(v) - center_));
  scale_ = 1 / size;
  used_ = (count + kLanes - 1) / kLanes;
  for (std::size_t k = 0; k < used_; ++k) {
    planes_[k] = Planes{};
    planes_[k].margin += std::numeric_limits<float>::infinity();
  }
  for (std::size_t n = 0; n < count; ++n) {
    const Disk::BoundaryEdge& edge = disk_->boundary[n];
    known_[edge.from].planes |= std::uint32_t{1} << n;
    known_[edge.to].planes |= std::uint32_t{1} << n;
    const Vec3 outwards = cross(point(edge.to) - point(edge.from), normals_[edge.facet]);
    const Vec3 normal = outwards / sum_of_sizes(outwards);
    const Vec3 from = scale_ * (point(edge.from) - center_);
    Planes& to = planes_[n / kLanes];
    to.x[n % kLanes] = static_cast<float>(normal.x);
    to.y[n % kLanes] = static_cast<float>(normal.y);
    to.z[n % kLanes] = static_cast<float>(normal.z);
    to.offset[n % kLanes] = static_cast<float>(dot(normal, from));
    to.margin[n % kLanes] = kSingleMargin * static_cast<float>(sum_of_sizes(from)) + kUnderflow;
  }
  // The disk's own vertices must be inside, but for the ends of a plane's side.
  separating_ = ~std::uint32_t{0};
  for (const VertexId v : vertices) separating_ &= known_[v].planes | planes_with(v, -1);
  for (const VertexId v : vertices) known_[v].planes &= separating_;
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
  const double margin = kMargin * longest2 * sum_of_sizes(along);
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

std::uint32_t DiskCrossing::planes_with(VertexId v, float sign) const {
  const Vec3 p = scale_ * (point(v) - center_);
  const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  const float margin = kSingleMargin * (std::fabs(x) + std::fabs(y) + std::fabs(z));
  std::uint32_t planes = 0;
  for (std::size_t k = 0; k < used_; ++k) {
    const Planes& of = planes_[k];
    const Four above = sign * (of.x * x + of.y * y + of.z * z - of.offset);
    const auto bits = (above > of.margin + margin) & Bits{1, 2, 4, 8};
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(bits);
    const std::uint64_t all = halves[0] | halves[1];
    planes |= static_cast<std::uint32_t>(all | all >> 32) << (kLanes * k);
  }
  return planes;
}

std::uint32_t DiskCrossing::planes_with_outside(VertexId v) {
  Known& known = known_[v];
  if (known.stamp != stamp_) known = {stamp_, planes_with(v, 1) & separating_};
  return known.planes;
}

bool DiskCrossing::meet(std::size_t f, const Triangle& t) const {
  const Triangle& s = disk_->facets[f];
  if (is_separated(*points_, s, normals_[f], t)) return false;
  const Vec3 &a = point(t[0]), &b = point(t[1]), &c = point(t[2]);
  return !is_separated(*points_, t, area_normal(a, b, c), s) && !collinear(a, b, c) &&
         triangles_intersect(*points_, s, t);
}

}  // namespace deliso
