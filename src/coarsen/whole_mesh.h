// SPDX-License-Identifier: MIT
// Questions about all facets of a mesh at once: which cross, and which a line meets.
#pragma once

#include "coarsen/facet_cells.h"
#include "coarsen/fans.h"
#include "embedding/triangle_pair.h"
#include "exact/predicates.h"
#include "mesh/tri_mesh.h"

namespace deliso {

class WholeMesh {
 public:
  // Keeps a reference. Dead facets are left out.
  explicit WholeMesh(const TriMesh& mesh);

  // The area normal of a live facet.
  const Vec3& normal(FaceId f) const { return normals_[f]; }
  bool has_area(FaceId f) const {
    const auto& [a, b, c] = mesh_.faces[f].v;
    return length2(normals_[f]) > 0 &&
           !collinear(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
  }

  // Calls visit(f, g) for two facets that cross, by exact predicates, once or more. Asks only those
  // for which asks(f, g), and none without an area.
  template <class Asks, class Visit>
  void for_each_crossing(Asks&& asks, Visit&& visit) const {
    const IdArray<VertexId, std::uint8_t> is_fan = stars_that_are_fans(mesh_, normals_);
    cells_.for_each_pair([&](FaceId f, FaceId g) {
      if (!asks(f, g)) return;
      const Triangle &s = mesh_.faces[f].v, &t = mesh_.faces[g].v;
      for (const VertexId q : s) {
        if (is_fan[q] != 0 && has_corner(t, q)) return;
      }
      if (is_separated(mesh_.points, s, normals_[f], t) ||
          is_separated(mesh_.points, t, normals_[g], s) || !has_area(f) || !has_area(g)) {
        return;
      }
      if (triangles_intersect(mesh_.points, s, t)) visit(f, g);
    });
  }

  // Returns the first facet but `from` that the line from p along the axis meets, up to the
  // coordinate `end`; kNoId: none.
  FaceId first_met(FaceId from, const Vec3& p, int axis, double end) const;

  // Calls visit(axis, sign) for the directions along axes in which lines leave facet f, not nearly
  // in its plane.
  template <class Visit>
  void for_each_way_from(FaceId f, Visit&& visit) const {
    constexpr double kGrazing = 0.1;
    const Vec3& n = normals_[f];
    for (int axis = 0; axis < 3; ++axis) {
      if (n[axis] * n[axis] < kGrazing * kGrazing * length2(n)) continue;
      visit(axis, 1.0);
      visit(axis, -1.0);
    }
  }
  Vec3 middle(FaceId f) const {
    const auto& [a, b, c] = mesh_.faces[f].v;
    return (mesh_.points[a] + mesh_.points[b] + mesh_.points[c]) / 3;
  }

 private:
  const TriMesh& mesh_;
  const FacetCells cells_;
  IdArray<FaceId, Vec3> normals_;
};

}  // namespace deliso
