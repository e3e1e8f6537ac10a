// SPDX-License-Identifier: MIT
// What is wrong with a facet: how far the worst criterion is passed, and whether it is Delaunay. By
// the first the queue is ordered; of both together rearrangements (refine/collapse.h,
// refine/move.h) want less.
#pragma once

#include "refine/replace_disk.h"
#include "surface/criteria.h"

namespace deliso {

class Judge {
 public:
  // Keeps references.
  Judge(const SurfaceMesh& surface_mesh, const DiskReplacer& replacer, const Parameters& parameters)
      : s_(surface_mesh), replacer_(replacer), parameters_(parameters) {}

  // Of a facet with these corners; without a surface point h is as large as it can be.
  FacetShape shape(const Triangle& v, const Dual& dual) const {
    const std::vector<Vec3>& p = s_.mesh.points;
    FacetShape shape = measure(p[v[0]], p[v[1]], p[v[2]], dual.center);
    if (!dual.on_surface) shape.h = shape.r;
    shape.pole = s_.pole(v);
    return shape;
  }
  // Over 1: a criterion is not met.
  double violation(const Triangle& v, const Dual& dual) const {
    return deliso::violation(shape(v, dual), parameters_.refinement);
  }

  double cost_of_shape(const Triangle& v, const Dual& dual) const {
    const double over = violation(v, dual);
    return over > 1 ? over : 0;
  }
  double cost_of_ball(const Triangle& v, const Dual& dual) const {
    return !dual.on_surface || replacer_.holds_vertex(v, dual) ? kNotDelaunay : 0;
  }

 private:
  // A facet over a limit costs 1 and how much it is over; this is what one that is not Delaunay
  // costs.
  static constexpr double kNotDelaunay = 0.3;

  const SurfaceMesh& s_;
  const DiskReplacer& replacer_;
  const Parameters& parameters_;
};

}  // namespace deliso
