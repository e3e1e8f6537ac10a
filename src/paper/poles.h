// SPDX-License-Identifier: MIT
// ComputePoles of paper Figure 9. The disk V_q cap Sigma separates V_q into two parts. In each the
// Voronoi vertex furthest from q is a pole; h_q is the distance to the nearer pole (§3.2, after
// Amenta and Bern 1999).
#pragma once

#include <array>
#include <vector>

#include "delaunay/triangulation.h"
#include "paper/intersect.h"

namespace deliso::paper {

// Returns of every site the distances to its poles outside and inside Sigma; 0: it has none there.
// A Voronoi vertex is in the part of its side of Sigma. Beyond the box Sigma goes on along the
// normal of its faces: g there is that of the nearest point of the box.
std::vector<std::array<double, 2>> both_poles(const Triangulation& del, const Sigma& sigma);
// Returns h_q of every site.
std::vector<double> compute_poles(const Triangulation& del, const Sigma& sigma);

}  // namespace deliso::paper
