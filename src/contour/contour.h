// SPDX-License-Identifier: MIT
// The exact contour T of a volume: a triangle mesh with the topology of the trilinear surface
// Sigma = g^-1(kappa), inside meaning g >= kappa. Voxel by voxel: grid edges that Sigma crosses
// give vertices, voxel faces give the segments between them (asymptotic decider, Nielson and Hamann
// 1991), the segments close into loops, and each loop bounds a disk unless two of them bound one
// tube, which a plane swept through the voxel decides (contour/voxel_topology.h). It is the ground
// truth of components, Euler number and boundary loops, and T seeds and certifies the mesh.
//
// Invariants of a ContourMesh:
//   I1  every vertex lies on Sigma: a crossing of a grid edge, or one more point inside a voxel
//       (in a split voxel also a crossing of an edge of its cells, or a point inside a cell);
//   I2  T is an edge- and vertex-manifold, with boundary on the box of the volume only;
//   I3  triangles are counter-clockwise seen from g < kappa;
//   I4  a vertex lies on a face of the box exactly when its bit in `box_faces` is set, and then
//       that coordinate is the box's to the last bit; all others lie strictly inside the box
//       (unless they lie at a sample equal to kappa);
//   I5  within its voxel each piece of T is what the piece of Sigma is (disk or tube), so T and
//       Sigma are homeomorphic, component by component, and so are their boundaries;
//   I6  everything is in scan order (x fastest, then y, z): vertices of a slab of voxels before
//       those of the next, components by the first voxel that meets them.
// No piece of Sigma is closed within a voxel: g is harmonic there, so it would be constant inside.
//
// Samples that equal kappa are inside, by the same rule everywhere, so T keeps its topology then
// too; only vertices may coincide. effective_isovalue() avoids that.
// Memory beside the result: two layers of edge slots and sample bits, O(slice), for each thread;
// with several of these T is put together from parts, and for a moment there twice.
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
#include "volume/volume.h"

namespace deliso {

// One connected component of Sigma.
struct ContourComponent {
  std::int64_t euler = 0;       // V - E + F
  std::uint64_t crossings = 0;  // grid edges it crosses
  std::uint64_t pieces = 0;     // pieces in voxels: its voxels, those it visits twice counted so
  std::uint64_t tubes = 0;      // pieces that are tubes
  std::uint64_t boundary_loops = 0;
  Index3 lo, hi;  // first and last voxel it visits along each axis

  // The longest side of its bounding box, in voxels.
  int side() const { return 1 + std::max({hi.i - lo.i, hi.j - lo.j, hi.k - lo.k}); }

  friend bool operator==(const ContourComponent&, const ContourComponent&) = default;
};

struct ContourSummary {
  std::vector<ContourComponent> components;  // by first voxel in scan order
  std::uint64_t active_voxels = 0;
  std::uint64_t tied_saddles = 0;  // voxels with a face whose saddle is at kappa, to the last bits

  std::int64_t euler() const;
  std::uint64_t boundary_loops() const;
  TopologyCounts topology() const { return {components.size(), euler(), boundary_loops()}; }
  friend bool operator==(const ContourSummary&, const ContourSummary&) = default;
};

// Returns for each component whether it is to be meshed.
std::vector<std::uint8_t> chosen_components(const ContourSummary& summary,
                                            const ComponentChoice& choice);

// The closed curves in which Sigma meets the box. Chain c is vertices[first[c] .. first[c + 1]),
// closed from the last to the first; consecutive vertices are crossings of grid edges (or of those
// of a split voxel's cells) on one pixel of one box face. Chains run as the triangles of T do, so
// that T lies on the left seen from where g < kappa, and each starts at its smallest vertex.
struct BoundaryChains {
  std::vector<std::uint32_t> first{0};
  std::vector<VertexId> vertices;
  std::vector<BoxFace> face;              // of the segment from this vertex to the next
  std::vector<std::uint8_t> on_box_edge;  // the curve turns from one face to another at this vertex
  std::vector<std::uint32_t> component;   // one per chain

  std::size_t size() const { return component.size(); }
  std::span<const VertexId> chain(std::size_t c) const {
    return std::span(vertices).subspan(first[c], first[c + 1] - first[c]);
  }
};

struct ContourMesh {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> component;  // per vertex, index into summary.components
  std::vector<std::uint8_t> box_faces;   // per vertex, bit f: on box face f; two bits on a box edge
  std::vector<std::array<VertexId, 3>> triangles;
  BoundaryChains boundary;
  ContourSummary summary;
  std::uint64_t split_voxels = 0;  // voxels that were split
  // The voxels whose triangles might cross, since they are made of several pieces or follow the
  // cells of a voxel beside them; in scan order, as all triangles are.
  struct VoxelTriangles {
    std::uint64_t voxel;  // voxel_number()
    std::size_t first, end;
  };
  std::vector<VoxelTriangles> crowded;

  bool on_boundary(VertexId v) const { return box_faces[v] != 0; }
};

// T itself, in one pass over the samples, the same with any number of threads. A volume without
// voxels (a dimension of 1) has none. Throws InputError when T would have 2^32 - 1 vertices or
// more.
ContourMesh build_contour(const Volume& volume, double kappa, int threads = 1);

// Where T is to be finer. A split voxel is cut into i x j x k cells, whose corners have the
// interpolant's own values, and becomes what the cells hold.
struct ContourSplit {
  std::vector<std::uint64_t> voxels;  // voxel_number()s, ascending; inactive ones are passed over
  Index3 factor{4, 4, 4};             // cells of each listed voxel, >= 1
  // Cells of every other active voxel, >= 1, but for those that share a face with a split voxel of
  // the list: these stay whole, so that cells of two sizes never meet.
  Index3 elsewhere{1, 1, 1};
};

// Voxels counted in scan order; `dims` are the volume's, in samples.
constexpr std::uint64_t voxel_number(Index3 dims, Index3 voxel) {
  const auto n = [](int i) { return static_cast<std::uint64_t>(i); };
  return n(voxel.i) + n(dims.i - 1) * (n(voxel.j) + n(dims.j - 1) * n(voxel.k));
}

// The voxel of that number.
constexpr Index3 numbered_voxel(Index3 dims, std::uint64_t number) {
  const auto nx = static_cast<std::uint64_t>(dims.i - 1),
             ny = static_cast<std::uint64_t>(dims.j - 1);
  return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny),
          static_cast<int>(number / nx / ny)};
}

// The voxel across face f of one; it may lie outside the volume.
inline Index3 beyond(Index3 voxel, int f) {
  voxel[f >> 1] += (f & 1) != 0 ? 1 : -1;
  return voxel;
}

// T, finer where `split` says. It keeps I1-I6 and the topology of the plain T, component by
// component: the two have equal summaries, which count crossings and pieces of the voxels, not of
// their cells. The plain T's crossings of grid edges are vertices here too, in the same places and
// in the same order. A voxel beside a split one keeps its own pieces, with loops that have more
// vertices; boundary chains go from cell to cell. Where rounding would give the cells of a voxel
// another topology than the voxel (the saddle of a face at kappa, to the last bits), it is left
// whole. Without split voxels the result is that of build_contour(volume, kappa). Costs a second
// look at each listed voxel beside the pass itself.
ContourMesh build_contour(const Volume& volume, double kappa, const ContourSplit& split,
                          int threads = 1);

// The summary alone, without T: for volumes of any size.
ContourSummary summarize_contour(const Volume& volume, double kappa, int threads = 1);

// The isovalue that the geometry works at: effective_isovalue(), lowered once more where saddles
// are tied. Sigma meets itself there (a checkerboard at its mean is nothing but that); a tied
// saddle counts as inside, so lowering kappa keeps the topology and parts what touches. Of a block
// it is isovalue_of_blocks().
double settled_isovalue(const Volume& volume, double kappa, int threads = 1);
// T, or its summary, at that isovalue, which kappa becomes.
ContourSummary summarize_settled_contour(const Volume& volume, double& kappa, int threads = 1);
ContourMesh build_settled_contour(const Volume& volume, double& kappa, int threads = 1);

}  // namespace deliso
