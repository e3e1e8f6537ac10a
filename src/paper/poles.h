// SPDX-License-Identifier: MIT
// ComputePoles of paper Figure 9. The disk V_q cap Sigma separates V_q into two parts. In each the
// Voronoi vertex furthest from q is a pole; h_q is the distance to the nearer pole (§3.2, after
// Amenta and Bern 1999).
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "paper/intersect.h"

namespace deliso::paper {

// Returns h_q of every site. A Voronoi vertex is in the part of its side of Sigma; one outside the
// box, in that of the place where the segment from q to it leaves the box.
std::vector<double> compute_poles(const Triangulation& del, const Sigma& sigma);

}  // namespace deliso::paper
