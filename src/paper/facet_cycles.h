// SPDX-License-Identifier: MIT
// What Recover of Figure 5 leaves out of the algorithms that it shortens (Cheng, Dey, Ramos and Ray
// 2004): a sample that meets every component of Sigma, and a test of Voronoi facets. Where V_pq
// meets Sigma, but no edge of V_pq does, it meets it in closed curves: a facet cycle. Then neither
// the edges nor the disks D_q tell that a tunnel or a neck of Sigma passes through V_pq.
#pragma once

#include <optional>

#include "paper/restricted.h"

namespace deliso::paper {

// Returns points of Sigma next to the lowest sample of each region of samples, inside or outside,
// that edges of the grid connect: there Sigma has a piece that bounds the region from below. They
// take the place of critical points of Sigma. Throws InputError for 2^32 samples and more.
std::vector<Vec3> points_below_regions(Sigma& sigma);

// Returns a point of Sigma in a Voronoi facet of q whose edges do not meet Sigma, the furthest from
// q, if it is further than `least` from q. Found on the facet's lines in the planes of the samples:
// a closed curve within one voxel is not.
std::optional<Vec3> facet_cycle(const RestrictedDelaunay& del, SiteId q, double least,
                                SearchCounters& counters);

}  // namespace deliso::paper
