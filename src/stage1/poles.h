// SPDX-License-Identifier: MIT
// Pole heights (paper §2.2.1 and §3.2), after Amenta and Bern 1999: h_q is the distance from q to
// the furthest Voronoi vertex of V_q on the nearer of the surface's two sides.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "surface/parameters.h"
#include "surface/report.h"

namespace deliso {

// One height per vertex id; none where no criterion asks for them. A side is told by the gradient
// at q. Vertices on the hull have none of their own; the auxiliary vertices (stage1/first_sample.h)
// keep those of the surface off it.
std::vector<double> compute_poles(const Triangulation& triangulation, const Isosurface& surface,
                                  const Parameters& parameters, Report& report);

}  // namespace deliso
