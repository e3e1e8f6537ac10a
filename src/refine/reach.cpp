// SPDX-License-Identifier: MIT
#include "refine/reach.h"

#include <algorithm>
#include <tuple>

namespace deliso {
namespace {

double distance2_to_facet(const TriMesh& mesh, FaceId f, const Vec3& p) {
  const Triangle& v = mesh.faces[f].v;
  return distance2_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

// The nearest facet, looked for in balls that grow.
FarPoint nearest(const TriMesh& mesh, const FacetGrid& grid, std::size_t witness, const Vec3& p,
                 double radius) {
  FarPoint best{witness, kNoId, 0};
  for (int doublings = 0; best.facet == kNoId && doublings < 32; ++doublings, radius *= 2) {
    best.distance2 = radius * radius;
    grid.any(grid.box_around(p, radius), [&](FaceId f, const FacetGrid::Box&) {
      const double d2 = distance2_to_facet(mesh, f, p);
      if (d2 < best.distance2 || (d2 == best.distance2 && f < best.facet)) {
        best.distance2 = d2;
        best.facet = f;
      }
      return false;
    });
  }
  return best;
}

}  // namespace

std::vector<FarPoint> far_points(const TriMesh& mesh, const FacetGrid& grid,
                                 std::span<const Vec3> witnesses, double limit) {
  std::vector<FarPoint> far;
  for (std::size_t n = 0; n < witnesses.size(); ++n) {
    const Vec3& p = witnesses[n];
    const bool is_near = grid.any(grid.box_around(p, limit), [&](FaceId f, const FacetGrid::Box&) {
      return distance2_to_facet(mesh, f, p) <= limit * limit;
    });
    if (is_near) continue;
    const FarPoint at = nearest(mesh, grid, n, p, 2 * limit);
    if (at.facet != kNoId) far.push_back(at);
  }
  const auto furthest_of_facet = [](const FarPoint& a, const FarPoint& b) {
    return std::tie(a.facet, b.distance2, a.witness) < std::tie(b.facet, a.distance2, b.witness);
  };
  std::sort(far.begin(), far.end(), furthest_of_facet);
  far.erase(std::unique(far.begin(), far.end(),
                        [](const FarPoint& a, const FarPoint& b) { return a.facet == b.facet; }),
            far.end());
  std::sort(far.begin(), far.end(), [](const FarPoint& a, const FarPoint& b) {
    return std::tie(b.distance2, a.witness) < std::tie(a.distance2, b.witness);
  });
  return far;
}

bool is_on_own_sheet(const TriMesh& mesh, FaceId f, const Vec3& p, const Isosurface& surface,
                     SurfacePointFinder& finder, SearchCounters& counters) {
  const Triangle& v = mesh.faces[f].v;
  const Vec3 normal = area_normal(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
  if (!(dot(surface.gradient(p), normal) < 0)) return false;
  return std::all_of(v.begin(), v.end(), [&](VertexId q) {
    return finder.on_one_sheet(p, mesh.points[q], normal, counters);
  });
}

}  // namespace deliso
