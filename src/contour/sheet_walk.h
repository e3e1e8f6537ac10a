// SPDX-License-Identifier: MIT
// Whether two points of Sigma lie on one sheet of it: a walk over the pieces of Sigma, from voxel
// to voxel, tells. Pieces of two voxels belong together where they share a segment of a loop on the
// face between the voxels (contour/voxel_topology.h). No distance tells, and no direction: another
// component may come nearer than edges are long, and face the same way.
//
//   W1  Between voxels the answer rests on exact signs alone.
//   W2  Within a voxel of several pieces, a point is on the piece whose loop it is nearest to.
//   W3  The walk makes two steps more, at most, than the voxels of both points are apart along the
//       axes. A longer way around does not count: another part of the same component is another
//       sheet.
#pragma once

#include <cstdint>
#include <vector>

#include "contour/voxel_topology.h"
#include "volume/volume.h"

namespace deliso {

class SheetWalk {
 public:
  // Keeps a reference to the volume.
  SheetWalk(const Volume& volume, double kappa) : volume_(volume), kappa_(kappa) {}

  // True if a sheet leads from p to q. Also if p lies outside the volume, or Sigma does not pass
  // its voxel: of such a point no sheet is known. Not if Sigma does not pass the voxel of q.
  bool leads(const Vec3& p, const Vec3& q);

 private:
  // The pieces in a voxel: disks, each of a loop, or a tube of two.
  struct Pieces {
    Pieces(const Volume& volume, double kappa, Index3 voxel);
    // Returns the number of the loop's piece.
    int piece_of(int loop) const { return loop == tube.b ? tube.a : loop; }
    int loop_with(int edge) const;
    // Returns the piece nearest to a point. pre: there is one.
    int nearest(const Volume& volume, const Vec3& p) const;

    Index3 at;
    VoxelValues values;
    VoxelLoops loops;
    Tube tube;
  };
  struct Step {
    int steps, left;  // made until there, and to the last voxel along the axes
    Index3 voxel;
    int edge;  // of the voxel: the walk came over a segment that begins or ends there

    static bool is_after(const Step& a, const Step& b);
  };

  void walk_on(const Pieces& from, int piece, int steps, Index3 last);
  std::uint8_t& visited(Index3 voxel);

  const Volume& volume_;
  double kappa_;
  int most_steps_ = 0;
  Index3 low_, size_;                  // of the voxels in which the walk stays
  std::vector<std::uint8_t> visited_;  // per voxel, the pieces, by bits
  std::vector<Step> ahead_;            // a heap, the shortest way on top
};

}  // namespace deliso
