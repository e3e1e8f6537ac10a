// SPDX-License-Identifier: MIT
#include "mesh/vertex_grid.h"

#include "base/check.h"

namespace deliso {
namespace {

constexpr double kCellsPerVertex = 8;

int cells_along(double length, double cell) {
  return 1 + static_cast<int>(length / cell);
}

}  // namespace

VertexGrid::VertexGrid(const Box3& box, std::size_t vertices, double cell)
    : lower_(box.lo), cell_(cell), next_(vertices, kNoId) {
  const Vec3 size = box.size();
  const double most = kCellsPerVertex * static_cast<double>(vertices) + 1;
  while ((size.x / cell_ + 1) * (size.y / cell_ + 1) * (size.z / cell_ + 1) > most) cell_ *= 2;
  dims_ = {cells_along(size.x, cell_), cells_along(size.y, cell_), cells_along(size.z, cell_)};
  first_.assign(number({0, 0, dims_.k}), kNoId);
}

VertexGrid::Cell VertexGrid::cell_at(const Vec3& p) const {
  const auto along = [&](double x, double lower, int cells) {
    return static_cast<int>(std::clamp((x - lower) / cell_, 0.0, static_cast<double>(cells - 1)));
  };
  return {along(p.x, lower_.x, dims_.i), along(p.y, lower_.y, dims_.j),
          along(p.z, lower_.z, dims_.k)};
}

void VertexGrid::add(VertexId v, const Vec3& at) {
  VertexId& first = first_[number(cell_at(at))];
  next_[v] = first;
  first = v;
}

void VertexGrid::remove(VertexId v, const Vec3& at) {
  VertexId* link = &first_[number(cell_at(at))];
  while (*link != v) {
    DELISO_ASSERT(*link != kNoId);
    link = &next_[*link];
  }
  *link = next_[v];
}

}  // namespace deliso
