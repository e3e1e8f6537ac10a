// SPDX-License-Identifier: MIT
// Pole heights (paper §2.2.1 and §3.2), after Amenta and Bern 1999: h_q is the distance from q to
// the furthest Voronoi vertex of V_q on the nearer of the surface's two sides.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "surface/options.h"
#include "isosurface/isosurface.h"

namespace deliso {

// One height per vertex id. A side is told by the gradient at q. Vertices on the hull have none of
// their own; the auxiliary vertices (init_triangulation.h) keep those of the surface off it.
std::vector<double> compute_poles(const Triangulation& triangulation, const Isosurface& surface,
                                  PoleSide side = PoleSide::nearer);

// h_sigma: the mean over the facet's vertices.
inline double facet_pole(std::span<const double> poles, const std::array<VertexId, 3>& v) {
  return (poles[v[0]] + poles[v[1]] + poles[v[2]]) / 3;
}

}  // namespace deliso
