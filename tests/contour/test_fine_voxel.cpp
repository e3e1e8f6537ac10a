// SPDX-License-Identifier: MIT
// A voxel cut into cells holds the surface of the whole.
#include "contour/fine_voxel.h"

#include <doctest/doctest.h>

#include "base/random.h"

using namespace deliso;

// Among so many voxels g++ 12 sorted some cells' columns wrongly (unswitched_loop.cpp), and found
// tubes that are not there.
TEST_CASE("the cells of random voxels have the topology of the voxel") {
  FineVoxel fine({4, 4, 1});
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    CAPTURE(n);
    Corners corners;
    for (double& value : corners) value = random.uniform(-1, 1);
    const int mask = mask_of(corners);
    const VoxelValues values(corners, 0);
    const VoxelLoops loops = voxel_loops(mask, values);
    fine.load(corners);
    CHECK(fine.agrees_with(loops, find_tube(mask, values, loops)));
  }
}
