// SPDX-License-Identifier: MIT
// The exact contour T of a volume: a triangle mesh with the topology of the trilinear surface Sigma
// = g^-1(kappa). Inside means g >= kappa. T is built voxel by voxel. Grid edges that Sigma crosses
// give vertices. Voxel faces give the segments between them (asymptotic decider, Nielson and Hamann
// 1991), and the segments close into loops. Each loop bounds a disk, unless two loops bound one
// tube; a plane swept through the voxel decides (contour/voxel_topology.h). T is the ground truth
// of components, Euler number and boundary loops. The mesh begins with it and is compared with it.
//
// Invariants of a ContourMesh:
//   I1  Every vertex lies on Sigma: a crossing of a grid edge, or one more point inside a voxel. In
//       a split voxel it may also be a crossing of a cell's edge, or a point inside a cell.
//   I2  T is an edge- and vertex-manifold. Its boundary lies on the box of the volume only.
//   I3  Triangles are counter-clockwise seen from g < kappa.
//   I4  A vertex lies on a face of the box exactly if its bit in `box_faces` is set. Then that
//       coordinate is the box's to the last bit. All others lie strictly inside the box (unless
//       they lie at a sample equal to kappa).
//   I5  Within its voxel each piece of T is a disk or a tube as the piece of Sigma is. So T and
//       Sigma are homeomorphic, component by component, and so are their boundaries.
//   I6  The order is scan order (x fastest, then y, z). Vertices of a layer of voxels precede those
//       of the next. Components are ordered by the first voxel that they meet.
// No piece of Sigma is closed within a voxel: g is harmonic there, so it would be constant inside.
//
// Samples equal to kappa are inside, by the same rule everywhere. So T keeps its topology then, but
// vertices may lie next to each other. geometric_isovalue() avoids that for most types.
// Memory besides the result: two layers of edge slots and sample bits, O(slice).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"
#include "base/topology_counts.h"
#include "base/vec3.h"
#include "contour/boundary_loop.h"
#include "volume/volume.h"

namespace deliso {

// One connected component of Sigma.
struct ContourComponent {
  std::int64_t euler = 0;       // V - E + F
  std::uint64_t crossings = 0;  // grid edges it crosses
  std::uint64_t pieces = 0;     // pieces in voxels; a voxel with two pieces counts twice
  std::uint64_t tubes = 0;      // pieces that are tubes
  std::uint64_t boundary_loops = 0;
  Index3 first;   // the first voxel it visits in scan order
  Index3 lo, hi;  // first and last voxel it visits along each axis

  // Adds the counts of a piece of it, and unites their voxels.
  void add(const ContourComponent& piece) {
    euler += piece.euler;
    crossings += piece.crossings;
    pieces += piece.pieces;
    tubes += piece.tubes;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], piece.lo[axis]);
      hi[axis] = std::max(hi[axis], piece.hi[axis]);
    }
  }
  // The longest side of its bounding box, in voxels.
  int side() const { return 1 + std::max({hi.i - lo.i, hi.j - lo.j, hi.k - lo.k}); }

  friend bool operator==(const ContourComponent&, const ContourComponent&) = default;
};

struct ContourSummary {
  std::vector<ContourComponent> components;  // by first voxel in scan order
  std::uint64_t active_voxels = 0;

  std::int64_t euler() const;
  std::uint64_t boundary_loops() const;
  TopologyCounts topology() const { return {components.size(), euler(), boundary_loops()}; }
  friend bool operator==(const ContourSummary&, const ContourSummary&) = default;
};

// Returns for each component whether it is to be meshed.
std::vector<std::uint8_t> chosen_components(const ContourSummary& summary,
                                            const ComponentChoice& choice);

// The closed curves in which T ends on the box. Consecutive points are crossings of grid edges (or
// of edges of a split voxel's cells) on one pixel of one box face. Loops run as the triangles of T
// do: T lies on the left seen from g < kappa. Each starts at its smallest vertex. The seams of a
// block, its arcs on inner faces (Grid::inner_faces), are fixed.
struct ContourBoundary {
  BoundaryLoops loops;
  std::vector<std::vector<ContourId>> vertices;  // per loop: those at its points
  std::vector<std::uint32_t> component;          // per loop

  std::size_t size() const { return component.size(); }
  friend bool operator==(const ContourBoundary&, const ContourBoundary&) = default;
};

// Corners of a triangle of T.
using ContourTriangle = std::array<ContourId, 3>;

struct ContourMesh {
  IdArray<ContourId, Vec3> points;
  IdArray<ContourId, std::uint32_t> component;  // index into summary.components
  IdArray<ContourId, std::uint8_t> box_faces;   // bit f: on box face f; two bits on a box edge
  std::vector<ContourTriangle> triangles;
  ContourBoundary boundary;
  ContourSummary summary;
  std::uint64_t split_voxels = 0;  // voxels that were split
  // Voxels in which triangles cross, in the smallest cells too; ascending voxel_number()s.
  std::vector<std::uint64_t> crossed_voxels;
  // The voxels whose triangles might cross, in scan order as all triangles are. Such a voxel has
  // several pieces, follows the cells of a neighboring voxel, or is split at an inner face. There
  // the triangles that make its seam plain follow as an entry of their own.
  struct VoxelTriangles {
    std::uint64_t voxel;  // voxel_number()
    std::size_t first, end;
  };
  std::vector<VoxelTriangles> crowded;

  bool on_boundary(ContourId v) const { return box_faces[v] != 0; }
};

// Returns T, from one pass over the samples. T is empty if the volume has no voxels (a dimension of
// 1). Throws InputError if T has 2^32 - 1 vertices or more.
ContourMesh build_contour(const Volume& volume, double kappa);

// Removes the components with kept[c] == 0 from T (--largest, --min-component), and numbers the
// others anew. All later steps take T for the whole surface: the mesh, its boundary curves, and
// the samples of Stage 2. Vertices, triangles and loops stay in order. I1 to I6 hold;
// `summary.active_voxels` and the like still count voxels of the whole surface.
void keep_components(ContourMesh& contour, std::span<const std::uint8_t> kept);

// Returns the summary alone, without T: for volumes of any size.
ContourSummary summarize_contour(const Volume& volume, double kappa);

}  // namespace deliso
