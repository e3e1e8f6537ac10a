// SPDX-License-Identifier: MIT
// The surface point of a facet of a plain mesh: where its dual line meets Sigma the right way
// round. Without the Voronoi diagram nothing says which of the hits is V_sigma cap Sigma; it is the
// one nearest to the circumcenter (paper §2.2.2) of those that Sigma's outside is turned to as the
// facet is. The sheet beyond a gap or a wall thinner than the facet faces the other way; one beyond
// both is told by that sheet in between, on the chords to the corners.
#pragma once

#include <optional>
#include <vector>

#include "isosurface/isosurface.h"
#include "surface/surface_mesh.h"

namespace deliso {

class SurfacePointFinder {
 public:
  explicit SurfacePointFinder(const Isosurface& surface) : surface_(surface) {}

  // For the facet a, b, c, counter-clockwise seen from g < kappa. Nothing when there is no such
  // point within the circumradius and the longest edge's length, or the facet has no area.
  std::optional<Vec3> find(const Vec3& a, const Vec3& b, const Vec3& c, SearchCounters& counters);

  // The dual of that facet.
  Dual dual(const Vec3& a, const Vec3& b, const Vec3& c, SearchCounters& counters) {
    const auto x = find(a, b, c, counters);
    return x ? dual_at(a, b, c, *x) : dual_without_surface(a, b, c);
  }

  // The same on any line: center + t * normal, |t| <= limit; normal is a unit vector.
  std::optional<Vec3> nearest(const Vec3& center, const Vec3& normal, double limit,
                              SearchCounters& counters);

  // Where the steepest line through `from` meets Sigma within `limit`, turned as `normal` is.
  std::optional<Vec3> foot(const Vec3& from, const Vec3& normal, double limit,
                           SearchCounters& counters);

  // Whether no sheet that is turned away from `normal` lies between p and q, two points of Sigma.
  bool on_one_sheet(const Vec3& p, const Vec3& q, const Vec3& normal, SearchCounters& counters);

 private:
  bool faces_along(const Vec3& x, const Vec3& normal) const {
    return dot(surface_.gradient(x), normal) <= 0;
  }

  const Isosurface& surface_;
  std::vector<Hit> hits_;
};

}  // namespace deliso
