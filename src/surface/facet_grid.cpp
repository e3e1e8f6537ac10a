// SPDX-License-Identifier: MIT
#include "surface/facet_grid.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace deliso {
namespace {

constexpr std::size_t kFewest = 1024;

}  // namespace

FacetGrid::FacetGrid(const Box3& box, double cell) : first_(kFewest, kNoId) {
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  // Coordinates stay below 2^20 cells, and above one, so that cutting off rounds down.
  const double side = std::max(cell, longest * 0x1p-20);
  per_cell_ = side > 0 ? 1 / side : 1;
  margin_ = static_cast<float>((longest * per_cell_ + 2) * 0x1p-22);
  origin_ = box.lo - Vec3{2 / per_cell_, 2 / per_cell_, 2 / per_cell_};
}

FacetGrid::Box FacetGrid::box_of(std::span<const Vec3> points) const {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    double lo = points[0][a], hi = lo;
    for (const Vec3& p : points.subspan(1)) {
      lo = std::min(lo, p[a]);
      hi = std::max(hi, p[a]);
    }
    box.lo[axis] = static_cast<float>((lo - origin_[a]) * per_cell_) - margin_;
    box.hi[axis] = static_cast<float>((hi - origin_[a]) * per_cell_) + margin_;
  }
  return box;
}

FacetGrid::Box FacetGrid::box_of(const std::vector<Vec3>& points, const Triangle& t) const {
  const std::array<Vec3, 3> corners{points[t[0]], points[t[1]], points[t[2]]};
  return box_of(corners);
}

FacetGrid::Box FacetGrid::box_around(const Vec3& p, double radius) const {
  // Balls reach out of the volume's box; there is nothing to find.
  Box box = box_of({&p, 1});
  const auto reach = static_cast<float>(radius * per_cell_) + margin_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::clamp(box.lo[axis] - reach, 1.0f, 0x1p21f);
    box.hi[axis] = std::clamp(box.hi[axis] + reach, 1.0f, 0x1p21f);
  }
  return box;
}

int FacetGrid::level_of(const Box& box) {
  const float extent =
      std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
  return extent <= 1 ? 0 : std::ilogb(extent) + 1;
}

void FacetGrid::add(FaceId f, const Box& box) {
  if (f >= nodes_.size()) nodes_.resize(f + 1);
  if (size_ >= first_.size()) grow();
  const int level = level_of(box);
  const float scale = scale_of(level);
  const auto along = [&](std::size_t axis) {
    return static_cast<std::uint32_t>(box.lo[axis] * scale);
  };
  Node& node = nodes_[f];
  DELISO_ASSERT(node.level == kUnlisted);
  node.box = box;
  node.place = place_of(level, along(0), along(1), along(2));
  node.level = level;
  FaceId& first = first_[node.place & (first_.size() - 1)];
  node.next = first;
  first = f;
  ++count_[static_cast<std::size_t>(level)];
  ++size_;
}

void FacetGrid::remove(FaceId f) {
  Node& node = nodes_[f];
  FaceId* link = &first_[node.place & (first_.size() - 1)];
  while (*link != f) {
    DELISO_ASSERT(*link != kNoId);
    link = &nodes_[*link].next;
  }
  *link = node.next;
  --count_[static_cast<std::size_t>(node.level)];
  node.level = kUnlisted;
  --size_;
}

void FacetGrid::grow() {
  first_.assign(2 * first_.size(), kNoId);
  for (FaceId f = 0; f < nodes_.size(); ++f) {
    if (nodes_[f].level == kUnlisted) continue;
    FaceId& first = first_[nodes_[f].place & (first_.size() - 1)];
    nodes_[f].next = first;
    first = f;
  }
}

}  // namespace deliso
