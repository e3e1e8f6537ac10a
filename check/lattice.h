// SPDX-License-Identifier: MIT
// The lattice on which points are measured. Much that is measured at a point jumps: the gradient of
// g at a plane of samples, the Delaunay triangles of vertices on one sphere, whether a line that
// touches Sigma finds it. There rounding decides, and a volume that lies turned in the world would
// have another report. On the lattice a mesh has the same coordinates in every frame.
#pragma once

#include <cmath>
#include <vector>

#include "volume/grid.h"

namespace deliso {

// Steps of the lattice in a voxel: one is far above the rounding of a coordinate, and far below a
// millionth of a voxel, the least tolerance.
inline constexpr double kLatticeSteps = 0x1p26;

// Where between two points of the lattice one becomes the other. Not halfway: vertices between
// samples of whole numbers may lie there.
inline constexpr double kLatticeTurn = 0.414;

// Returns the points, each moved to one of the lattice around it. Planes of samples are in it.
inline std::vector<Vec3> on_lattice(const Grid& volume, std::vector<Vec3> points) {
  for (Vec3& p : points) {
    const Index3 voxel = volume.voxel_at(p);
    const Vec3 lo = volume.position(voxel), hi = volume.position(voxel + Index3{1, 1, 1});
    for (int axis = 0; axis < 3; ++axis) {
      const double side = hi[axis] - lo[axis];
      const double t =
          std::floor((p[axis] - lo[axis]) / side * kLatticeSteps + kLatticeTurn) / kLatticeSteps;
      p[axis] = t == 1 ? hi[axis] : lo[axis] + t * side;
    }
  }
  return points;
}

}  // namespace deliso
