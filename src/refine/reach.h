// SPDX-License-Identifier: MIT
// The other direction of the distance: no point of Sigma far from the mesh. Facets near Sigma say
// nothing of a finger that no facet enters; points of Sigma that lie densely, the witnesses, do.
#pragma once

#include <span>
#include <vector>

#include "refine/replace_disk.h"

namespace deliso {

// A witness too far from the mesh, and the facet nearest to it.
struct FarPoint {
  std::size_t witness;
  FaceId facet;
  double distance2;
};

// The witnesses further than `limit` from all facets, the furthest first. Of those nearest to one
// facet only the furthest.
std::vector<FarPoint> far_points(const TriMesh& mesh, const FacetGrid& grid,
                                 std::span<const Vec3> witnesses, double limit);

// Whether p, a point of Sigma near facet f, lies on the sheet that f follows: Sigma faces as f does
// at p, and no sheet that faces the other way lies between.
bool is_on_own_sheet(const TriMesh& mesh, FaceId f, const Vec3& p, const Isosurface& surface,
                     SurfacePointFinder& finder, SearchCounters& counters);

}  // namespace deliso
