// SPDX-License-Identifier: MIT
// An estimate of a mesh's number of vertices. It counts the grid edges that the surface crosses, at
// some of the samples. Each criterion needs a number of vertices per area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contour/contour.h"
#include "run/options.h"
#include "volume/volume.h"

namespace deliso {

struct SurfaceEstimate {
  double crossings = 0;  // of grid edges
  double area = 0;       // in squares of Grid::voxel()
  // Of the crossed edges along x and y, the share whose next edge is crossed too: sheets a sample
  // thick.
  double thin = 0;
};

// Returns the size of the surface from about 1 million samples, or all of a smaller volume. Within
// a few percent.
SurfaceEstimate estimate_surface(const Volume& volume, double kappa);

// Returns the expected number of vertices. By the bound on the distance it is right within a factor
// of 3, and mostly within 30 %, for noise too, after either stage. By the paper's criteria it is
// only an order of magnitude: their vertices at a crease depend on its angle. `surface`: the
// volume's at the isovalue.
double expected_vertices(const SurfaceEstimate& surface, const Grid& volume,
                         const Options& options);
inline double expected_vertices(const Volume& volume, double kappa, const Options& options) {
  return expected_vertices(estimate_surface(volume, kappa), volume, options);
}

}  // namespace deliso
