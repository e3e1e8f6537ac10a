// SPDX-License-Identifier: MIT
// How many vertices a mesh will have, before it is made: from how often the surface crosses grid
// edges in some slices of the volume, and from what a criterion asks of a piece of surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contour/contour.h"
#include "deliso/options.h"
#include "volume/volume.h"

namespace deliso {

struct SurfaceEstimate {
  double crossings = 0;  // of grid edges
  double area = 0;       // in voxels, squared; of the shortest side of one
};

// Looks at some 4 million samples, or at 32 slices where these are more, and at all of a smaller
// volume. Within a few percent where the surface is alike in neighboring slices.
SurfaceEstimate estimate_surface(const Volume& volume, double kappa);

// By the bound on the distance, within a factor of 3 for surfaces whose curvature is that of most
// data, a few voxels in radius; up to 6 too few for noise. By the paper's criteria no more than an
// order of magnitude, since what they spend on a crease depends on its angle.
// `surface`: the volume's at the isovalue.
double expected_vertices(const SurfaceEstimate& surface, const Volume& volume,
                         const Options& options);
inline double expected_vertices(const Volume& volume, double kappa, const Options& options) {
  return expected_vertices(estimate_surface(volume, kappa), volume, options);
}

// The fewest vertices that a mesh of the largest `count` of these components can have: for closed
// ones Heawood's bound (1890), for others those of one facet.
std::uint64_t fewest_vertices(std::vector<ContourComponent> components, std::size_t count);

}  // namespace deliso
