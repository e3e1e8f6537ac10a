// SPDX-License-Identifier: MIT
// The surface point of a facet of a plain mesh. The facet's dual line can meet Sigma several times,
// and no Voronoi diagram selects a hit. The surface point is the hit nearest to the circumcenter
// (paper §2.2.2) where Sigma faces as the facet does. The sheet across a gap or wall thinner than
// the facet faces the opposite way. A sheet behind that one faces as the facet does, and so may
// another component: a hit that is not near must be on the sheet of the corners.
#pragma once

#include <optional>
#include <vector>

#include "contour/sheet_walk.h"
#include "isosurface/patch_at.h"
#include "surface/surface_mesh.h"

namespace deliso {

class SurfacePointFinder {
 public:
  explicit SurfacePointFinder(const Isosurface& surface)
      : surface_(surface), walk_(surface.volume(), surface.kappa()) {}

  // Returns the surface point of the facet a, b, c, counter-clockwise seen from g < kappa. Nullopt
  // if none is within the circumradius and the longest edge's length, or the facet has no area.
  std::optional<Vec3> find(const Vec3& a, const Vec3& b, const Vec3& c, SearchCounters& counters);

  // Returns the dual of that facet.
  Dual dual(const Vec3& a, const Vec3& b, const Vec3& c, SearchCounters& counters) {
    const auto x = find(a, b, c, counters);
    return x ? dual_at(a, b, c, *x) : dual_without_surface(a, b, c);
  }

  // Returns the nearest hit on the line center + t * normal, |t| <= limit, where Sigma faces along
  // the unit vector `normal`.
  std::optional<Vec3> nearest(const Vec3& center, const Vec3& normal, double limit,
                              SearchCounters& counters) {
    return nearest(PatchAt(surface_, center), normal, limit, counters);
  }

  // Returns where the steepest line through `from` meets Sigma within `limit`. Nullopt if Sigma
  // does not face along `normal` there.
  std::optional<Vec3> foot(const Vec3& from, const Vec3& normal, double limit,
                           SearchCounters& counters);

  // True if p and q, points of Sigma, lie on one sheet (contour/sheet_walk.h).
  bool leads_to(const Vec3& p, const Vec3& q) { return walk_.leads(p, q); }

 private:
  std::optional<Vec3> nearest(const PatchAt& from, const Vec3& normal, double limit,
                              SearchCounters& counters);
  bool faces_along(const Vec3& x, const Vec3& normal) const {
    return dot(surface_.gradient(x), normal) <= 0;
  }

  const Isosurface& surface_;
  SheetWalk walk_;
  std::vector<Hit> hits_;
};

}  // namespace deliso
