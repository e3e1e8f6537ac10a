// SPDX-License-Identifier: MIT
#include "refine/crossing_guard.h"

#include <algorithm>
#include <cmath>

#include "base/sorted_list.h"
#include "contour/contour.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"
#include "mesh/collapse.h"

namespace deliso {

namespace {

constexpr std::size_t kTests = 100'000'000;  // a second or so
constexpr int kMostCells = 16;               // of a voxel, along an axis

bool boxes_meet(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [s_lo, s_hi] =
        std::minmax({points[s[0]][axis], points[s[1]][axis], points[s[2]][axis]});
    const auto [t_lo, t_hi] =
        std::minmax({points[t[0]][axis], points[t[1]][axis], points[t[2]][axis]});
    if (s_lo > t_hi || t_lo > s_hi) return false;
  }
  return true;
}

}  // namespace

CrossingGuard::CrossingGuard(const Volume& volume, const TriMesh& mesh,
                             std::span<const std::uint64_t> voxels, double cell)
    : volume_(volume), mesh_(mesh) {
  const Index3 count = volume.voxels();
  for (const std::uint64_t n : voxels) {
    const Index3 at = numbered_voxel(volume.dims(), n);
    for (int k = std::max(0, at.k - 1); k <= std::min(count.k - 1, at.k + 1); ++k) {
      for (int j = std::max(0, at.j - 1); j <= std::min(count.j - 1, at.j + 1); ++j) {
        for (int i = std::max(0, at.i - 1); i <= std::min(count.i - 1, at.i + 1); ++i) {
          voxels_.insert(voxel_number(volume.dims(), {i, j, k}));
        }
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double wanted = std::round(volume.spacing()[axis] / cell);
    cells_[axis] = static_cast<int>(std::clamp(wanted, 1.0, double{kMostCells}));
  }
  if (voxels_.empty()) return;
  tests_left_ = kTests;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) add(f);
}

template <class Visit>
void CrossingGuard::for_each_cell(const Triangle& t, Visit&& visit) const {
  Vec3 lo = mesh_.points[t[0]], hi = lo;
  for (const VertexId v : {t[1], t[2]}) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], mesh_.points[v][axis]);
      hi[axis] = std::max(hi[axis], mesh_.points[v][axis]);
    }
  }
  const Vec3 spacing = volume_.spacing();
  const Index3 voxels = volume_.voxels();
  const auto cell_at = [&](const Vec3& p) {
    Index3 cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = std::floor(p[axis] / spacing[axis] * cells_[axis]);
      cell[axis] = static_cast<int>(std::clamp(place, 0.0, 1.0 * voxels[axis] * cells_[axis] - 1));
    }
    return cell;
  };
  const Index3 first = cell_at(lo), last = cell_at(hi);
  // Counted voxel by voxel: a voxel's number, and the cell's in it.
  const auto per_voxel = static_cast<std::uint64_t>(cells_.i * cells_.j * cells_.k);
  const auto visit_voxel = [&](const Index3& voxel) {
    const std::uint64_t number = voxel_number(volume_.dims(), voxel);
    if (!voxels_.contains(number)) return;
    Index3 from, to;  // of the voxel's cells
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(0, first[axis] - voxel[axis] * cells_[axis]);
      to[axis] = std::min(cells_[axis] - 1, last[axis] - voxel[axis] * cells_[axis]);
    }
    for (int k = from.k; k <= to.k; ++k) {
      for (int j = from.j; j <= to.j; ++j) {
        for (int i = from.i; i <= to.i; ++i) {
          visit(number * per_voxel + static_cast<std::uint64_t>(i + cells_.i * (j + cells_.j * k)));
        }
      }
    }
  };
  for (int k = first.k / cells_.k; k <= last.k / cells_.k; ++k) {
    for (int j = first.j / cells_.j; j <= last.j / cells_.j; ++j) {
      for (int i = first.i / cells_.i; i <= last.i / cells_.i; ++i) visit_voxel({i, j, k});
    }
  }
}

void CrossingGuard::add(FaceId f) {
  for_each_cell(mesh_.faces[f].v, [&](std::uint64_t cell) {
    List& list = facets_[cell];
    list.facets.push_back(f);
    if (list.facets.size() >= list.full) tidy(cell, list);
  });
}

void CrossingGuard::tidy(std::uint64_t cell, List& list) const {
  std::vector<FaceId>& facets = list.facets;
  sort_out(facets);
  std::erase_if(facets, [&](FaceId f) {
    if (is_dead(mesh_.faces[f])) return true;
    bool meets = false;
    for_each_cell(mesh_.faces[f].v, [&](std::uint64_t other) { meets |= other == cell; });
    return !meets;
  });
  list.full = 2 * facets.size() + 32;
}

bool CrossingGuard::would_cross(std::span<const Triangle> created,
                                std::span<const FaceId> removed) const {
  const std::vector<Vec3>& points = mesh_.points;
  bool guarded = false, crosses = false;
  std::vector<FaceId> near;
  for (const Triangle& t : created) {
    near.clear();
    for_each_cell(t, [&](std::uint64_t cell) {
      guarded = true;
      const auto found = facets_.find(cell);
      if (found == facets_.end()) return;
      const std::vector<FaceId>& facets = found->second.facets;
      near.insert(near.end(), facets.begin(), facets.end());
    });
    tests_left_ -= std::min(tests_left_, near.size());
    if (near.empty()) continue;
    sort_out(near);
    if (collinear(points[t[0]], points[t[1]], points[t[2]])) return true;
    crosses = std::any_of(near.begin(), near.end(), [&](FaceId f) {
      if (is_dead(mesh_.faces[f])) return false;
      if (std::find(removed.begin(), removed.end(), f) != removed.end()) return false;
      const Triangle& other = mesh_.faces[f].v;
      if (!boxes_meet(points, t, other)) return false;
      return !collinear(points[other[0]], points[other[1]], points[other[2]]) &&
             triangles_intersect(points, t, other);
    });
    if (crosses) return true;
  }
  if (!guarded) return false;
  for (std::size_t a = 0; a < created.size(); ++a) {
    for (std::size_t b = a + 1; b < created.size(); ++b) {
      const Triangle &s = created[a], &t = created[b];
      if (collinear(points[s[0]], points[s[1]], points[s[2]]) ||
          collinear(points[t[0]], points[t[1]], points[t[2]]) ||
          triangles_intersect(points, s, t)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace deliso
