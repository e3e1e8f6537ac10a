// SPDX-License-Identifier: MIT
// Pole heights (paper §2.2.1 and §3.2), after Amenta and Bern 1999. On each side of Sigma the cell
// V_q has a furthest Voronoi vertex, the pole; h_q is the distance from q to the nearer pole.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "surface/parameters.h"
#include "surface/report.h"

namespace deliso {

// Returns the pole height of every vertex id; empty if no criterion needs them. The gradient at q
// distinguishes the sides. A cell on the hull has no such height; the auxiliary vertices
// (stage1/first_sample.h) keep the surface's vertices off the hull.
std::vector<double> compute_poles(const Triangulation& triangulation, const Isosurface& surface,
                                  const Parameters& parameters, Report& report);

}  // namespace deliso
