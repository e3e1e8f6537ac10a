// SPDX-License-Identifier: MIT
// Two meshes without a volume: the validity and topology of each, and the distances between them.
#pragma once

#include <array>
#include <cstddef>

#include "base/topology_counts.h"
#include "check/distances.h"
#include "check/faults.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// A mesh by itself. It may end anywhere.
struct MeshVerdict {
  Faults faults;
  std::size_t vertices = 0, triangles = 0;
  TopologyCounts topology;

  // Returns the handles of all components together: half of 2 less Euler number and loops of each.
  std::ptrdiff_t genus() const {
    const auto ends = static_cast<std::ptrdiff_t>(topology.boundary_loops);
    return static_cast<std::ptrdiff_t>(topology.components) - (topology.euler + ends) / 2;
  }
};

// `to_other`: from points of the surface, evenly spread, to the nearest triangle of the other mesh;
// the largest distance is also over all vertices. So the larger of the two largest is the
// Hausdorff distance, but for what no point of the spread met.
struct MeshComparison {
  struct Side {
    MeshVerdict mesh;
    Distances to_other;
  };
  std::array<Side, 2> sides;
};

// Compares meshes in one frame. Points further than `bound` are faults. Faults are in the result.
// Of a mesh without a triangle there are no distances. pre: corners are below the vertex count.
MeshComparison compare_meshes(const std::array<TriMesh, 2>& meshes, double bound, int threads = 1);

}  // namespace deliso
