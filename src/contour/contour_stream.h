// SPDX-License-Identifier: MIT
// One pass over the samples that walks the contour voxel by voxel, in scan order. A sink receives
// crossings and pieces (contour.cpp), and makes a mesh of them, or nothing if only the summary is
// needed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contour/components.h"
#include "contour/voxel_topology.h"

namespace deliso {

// The pieces of Sigma in an active voxel.
struct VoxelPieces {
  // Leaves vertex and label uninitialized.
  VoxelPieces(Index3 at, const Corners& c, const VoxelLoops& l, Tube t)
      : voxel(at), corners(c), loops(l), tube(t) {}

  Index3 voxel;
  const Corners& corners;  // values minus kappa
  const VoxelLoops& loops;
  Tube tube;
  std::array<ContourId, 12> vertex;            // on each of loops.edge
  std::array<std::uint32_t, kMaxLoops> label;  // of each loop's component

  std::span<const ContourId> vertices(int loop) const {
    return std::span(vertex).subspan(loops.first[loop], loops.edges(loop).size());
  }
};

// A segment of T on the box, directed as in its triangle.
struct BoundarySegment {
  ContourId from, to;
  std::uint32_t component;  // a label, later a component's number
  BoxFace face;
};

// A receiver of crossings and active voxels.
class ContourSink {
 public:
  ContourSink() = default;
  ContourSink(const ContourSink&) = delete;
  ContourSink& operator=(const ContourSink&) = delete;
  virtual ~ContourSink() = default;  // unreachable: sinks live on the stack

  // The grid edge from `sample` along `axis` is crossed and lies on these faces of the box. Its
  // ends have the values c0 and c1, minus kappa. Returns an id, unique among crossings on the box.
  virtual ContourId crossing(int axis, Index3 sample, double c0, double c1,
                             std::uint8_t box_faces) = 0;
  // An active voxel, once all its crossings are known.
  virtual void voxel(const VoxelPieces& pieces) = 0;
  // May replace the walk's segments on the box, in the end.
  virtual void replace_boundary(std::vector<BoundarySegment>&) {}
};

// The results of a walk that the sink does not receive.
struct WalkResult {
  GrowingComponents components;
  std::vector<BoundarySegment> boundary;
  std::uint64_t active_voxels = 0;
};

WalkResult walk_contour(const Volume& volume, double kappa, ContourSink& sink);

// Gives a mesh that a sink has filled its components, boundary and summary. `inner`: the inner
// faces of the volume.
void complete(ContourMesh& mesh, WalkResult found, unsigned inner);

}  // namespace deliso
