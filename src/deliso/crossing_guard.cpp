// SPDX-License-Identifier: MIT
#include "deliso/crossing_guard.h"

#include <algorithm>

#include "contour/contour.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"

namespace deliso {

CrossingGuard::CrossingGuard(const Volume& volume, const TriMesh& mesh,
                             std::span<const std::uint64_t> voxels)
    : volume_(volume), mesh_(mesh) {
  const Index3 count = volume.voxels();
  const auto nx = static_cast<std::uint64_t>(count.i), ny = static_cast<std::uint64_t>(count.j);
  for (const std::uint64_t n : voxels) {
    const Index3 at{static_cast<int>(n % nx), static_cast<int>(n / nx % ny),
                    static_cast<int>(n / nx / ny)};
    for (int k = std::max(0, at.k - 1); k <= std::min(count.k - 1, at.k + 1); ++k) {
      for (int j = std::max(0, at.j - 1); j <= std::min(count.j - 1, at.j + 1); ++j) {
        for (int i = std::max(0, at.i - 1); i <= std::min(count.i - 1, at.i + 1); ++i) {
          facets_[voxel_number(volume.dims(), {i, j, k})];
        }
      }
    }
  }
  if (!is_on()) return;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) add(f);
}

template <class Visit>
void CrossingGuard::for_each_voxel(const Triangle& t, Visit&& visit) const {
  Vec3 lo = mesh_.points[t[0]], hi = lo;
  for (const VertexId v : {t[1], t[2]}) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], mesh_.points[v][axis]);
      hi[axis] = std::max(hi[axis], mesh_.points[v][axis]);
    }
  }
  const Index3 first = volume_.voxel_at(lo), last = volume_.voxel_at(hi);
  for (int k = first.k; k <= last.k; ++k) {
    for (int j = first.j; j <= last.j; ++j) {
      for (int i = first.i; i <= last.i; ++i) visit(voxel_number(volume_.dims(), {i, j, k}));
    }
  }
}

void CrossingGuard::add(FaceId f) {
  for_each_voxel(mesh_.faces[f].v, [&](std::uint64_t voxel) {
    const auto found = facets_.find(voxel);
    if (found != facets_.end()) found->second.push_back(f);
  });
}

bool CrossingGuard::would_cross(std::span<const Triangle> created,
                                std::span<const FaceId> removed) const {
  const std::vector<Vec3>& points = mesh_.points;
  bool guarded = false, crosses = false;
  std::vector<FaceId> near;
  for (const Triangle& t : created) {
    near.clear();
    for_each_voxel(t, [&](std::uint64_t voxel) {
      const auto found = facets_.find(voxel);
      if (found == facets_.end()) return;
      guarded = true;
      near.insert(near.end(), found->second.begin(), found->second.end());
    });
    if (near.empty()) continue;
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    if (collinear(points[t[0]], points[t[1]], points[t[2]])) return true;
    crosses = std::any_of(near.begin(), near.end(), [&](FaceId f) {
      if (std::find(removed.begin(), removed.end(), f) != removed.end()) return false;
      const Triangle& other = mesh_.faces[f].v;
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
