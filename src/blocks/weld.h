// SPDX-License-Identifier: MIT
// Welds the meshes of blocks. Blocks that meet have the same vertices on their seam, to the last
// bit, and nothing else of either lies in the face between them (J1 and J2 of blocks/seam.h). So
// vertices at one place are one vertex, and every edge of a seam has one facet on either side. The
// boundary curves of blocks continue each other on the box, and are joined into loops of the whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "blocks/block.h"

namespace deliso {

struct WeldedMesh {
  SurfaceMesh mesh;
  std::shared_ptr<const BoundaryLoops> loops;  // of its chain
  IdArray<VertexId, std::uint8_t> on_seam;     // per vertex: nonzero on a seam
  std::vector<Vec3> samples_near_seams, samples;
};

// Empties the blocks. pre: they cover the volume, and none is refused.
WeldedMesh weld(std::vector<Block>& blocks);

}  // namespace deliso
