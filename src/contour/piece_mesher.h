// SPDX-License-Identifier: MIT
// Makes T from the pieces in voxels: positions of crossings, fans and stars over loops, bands over
// tubes.
// A cell is a voxel, or a part of one with the lattice values at its own corners.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>

#include "contour/contour.h"
#include "contour/contour_stream.h"
#include "contour/voxel_point.h"

namespace deliso {

// The place of a cell, in voxels.
struct CellFrame {
  Vec3 low, size;
};

// A share of an edge. Crossings keep this distance from its ends. Next to kappa they would round
// onto the sample, and so onto each other or onto the volume's box.
constexpr double kCrossingMargin = 1e-11;

// A share of the cell's sides. Where Sigma is thin, neighbors on a loop with a fan are at least
// this far apart: closer crossings make needles that Stage 2 cannot mend.
constexpr double kMinFanEdge = 0.45;
// Samples. Sigma is thin in a voxel if a grid line crosses it again within this distance. With 2
// there are as many needles as with stars at all short edges; with 1, a few more on ENGINE, TOOTH
// and LEG; with fans everywhere, four to six times as many on ANEURISM, TOOTH and BABY.
constexpr int kThinSamples = 2;

class PieceMesher final : public ContourSink {
 public:
  PieceMesher(ContourMesh& mesh, const Volume& volume, double kappa)
      : mesh_(mesh),
        volume_(volume),
        within_(volume.within()),
        kappa_(kappa),
        dims_(volume.dims()),
        first_(volume.first()) {}

  // Returns the position of a sample, in voxels.
  Vec3 place(Index3 sample) const { return to_vec3(first_ + sample); }

  ContourId crossing(int axis, Index3 sample, double c0, double c1,
                     std::uint8_t box_faces) override {
    Vec3 p = place(sample);
    p[axis] += std::clamp(c0 / (c0 - c1), kCrossingMargin, 1 - kCrossingMargin);
    return add_at(p, box_faces);
  }

  void voxel(const VoxelPieces& pieces) override {
    begin_voxel();
    cell({place(pieces.voxel), {1, 1, 1}}, pieces, pieces);
    end_voxel(pieces.voxel, is_crowded(pieces.loops));
  }

  // To be called before and after all cells of a voxel. `crowded`: its triangles might cross.
  void begin_voxel() { first_triangle_ = mesh_.triangles.size(); }
  void end_voxel(Index3 voxel, bool crowded) {
    if (!crowded) return;
    mesh_.crowded.push_back({voxel_number(dims_, voxel), first_triangle_, mesh_.triangles.size()});
  }
  // True if a cell has several pieces, or one whose star bends far.
  static bool is_crowded(const VoxelLoops& loops) { return loops.count > 1 || loops.first[1] > 6; }

  // As voxel(), for the pieces of a cell of `voxel`. pre: the vertices lie on the cell's surface.
  void cell(const CellFrame& frame, const VoxelPieces& pieces, const VoxelPieces& voxel) {
    if (fan(frame, pieces, voxel)) return;
    fill(frame, pieces, [&](int l) { return pieces.vertices(l); });
  }

  // Fills the loops by disks and a tube. `vertices(l)` are those of loop l.
  template <class Vertices>
  void fill(const CellFrame& frame, const VoxelPieces& pieces, Vertices&& vertices) {
    for (int l = 0; l < pieces.loops.count; ++l) {
      if (pieces.tube && l == pieces.tube.b) continue;
      if (pieces.tube && l == pieces.tube.a) {
        tube(frame, pieces.corners, vertices(l), vertices(pieces.tube.b), pieces.label[l]);
      } else {
        disk(frame, pieces.corners, vertices(l), pieces.label[l]);
      }
    }
  }

  // Adds a vertex at p, in voxels, in these faces of the box and off the others. Its component is
  // that of the first piece given with it.
  ContourId add_at(const Vec3& p, std::uint8_t box_faces, std::uint32_t label = kNoId) {
    if (mesh_.points.size() >= kNoId) throw InputError("the contour has 2^32 vertices or more");
    Vec3& at = mesh_.points.emplace_back(volume_.at_samples(p));
    for (int axis = 0; axis < 3 && !within_.contains(at); ++axis) {
      if ((box_faces >> (2 * axis) & 3) != 0) continue;
      at[axis] = std::clamp(at[axis], within_.lo[axis], within_.hi[axis]);
    }
    mesh_.box_faces.push_back(box_faces);
    mesh_.component.push_back(label);
    return ContourId(mesh_.points.size() - 1);
  }

 private:
  // True if Sigma is thin in the voxel: there are several pieces, or it crosses one of their grid
  // lines again. A line that leaves the volume is as its last sample.
  bool is_thin(const VoxelPieces& pieces) const {
    if (pieces.loops.count != 1) return true;
    for (const std::uint8_t e : pieces.loops.edges(0)) {
      const int axis = e / 4;
      for (const int corner : corners_of_edge(e)) {
        Index3 at = corner_of(pieces.voxel, corner);
        const bool inside = pieces.corners[corner] >= 0;
        const int step = (corner >> axis & 1) != 0 ? 1 : -1;
        for (int n = 0; n < kThinSamples; ++n) {
          at[axis] += step;
          if (at[axis] < 0 || at[axis] >= dims_[axis]) break;
          if ((volume_.sample(at.i, at.j, at.k) - kappa_ >= 0) != inside) return true;
        }
      }
    }
    return false;
  }

  // Makes a fan over the cell's only loop, from the vertex with the shortest chords. Returns false
  // if some face has more than one segment of the loop, or an edge is short where the voxel is
  // thin. Otherwise a face holds the ends of its segment and no other vertex of the loop. So no
  // chord lies in a face, where the cell across might have the same chord, and no two triangles
  // cross.
  bool fan(const CellFrame& frame, const VoxelPieces& pieces, const VoxelPieces& voxel) {
    const std::size_t n = pieces.loops.first[1];
    unsigned faces = 0;
    for (std::size_t k = 0; k < n; ++k) faces |= 1u << pieces.loops.face[k];
    if (pieces.loops.count != 1 || static_cast<std::size_t>(std::popcount(faces)) != n)
      return false;
    const std::span<const ContourId> loop = pieces.vertices(0);
    std::array<Vec3, 6> points;
    for (std::size_t i = 0; i < n; ++i) points[i] = mesh_.points[loop[i]];
    const auto after = [&](std::size_t i, std::size_t k) { return i + k < n ? i + k : i + k - n; };
    const Vec3 size = sides_of(frame);
    const Vec3 scale{1 / size.x, 1 / size.y, 1 / size.z};
    std::size_t from = 0;
    double least = std::numeric_limits<double>::infinity();
    bool has_short_edge = false;
    for (std::size_t i = 0; i < n; ++i) {
      const double edge2 = length2(times(points[i] - points[after(i, 1)], scale));
      has_short_edge |= edge2 < kMinFanEdge * kMinFanEdge;
      double chords = 0;
      for (std::size_t k = 2; k + 1 < n; ++k) chords += distance2(points[i], points[after(i, k)]);
      if (chords < least) from = i;
      least = std::min(least, chords);
    }
    if (has_short_edge && is_thin(voxel)) return false;
    for (const ContourId v : loop) mesh_.component[v] = pieces.label[0];
    for (std::size_t k = 1; k + 1 < n; ++k) {
      mesh_.triangles.push_back({loop[from], loop[after(from, k)], loop[after(from, k + 1)]});
    }
    return true;
  }

  // Makes a triangle, or a star around one more point of Sigma. `c` are the cell's corners.
  void disk(const CellFrame& cell, const Corners& c, std::span<const ContourId> loop,
            std::uint32_t label) {
    Vec3 sum;
    for (const ContourId v : loop) {
      mesh_.component[v] = label;
      sum = sum + mesh_.points[v];
    }
    if (loop.size() == 3) {
      mesh_.triangles.push_back({loop[0], loop[1], loop[2]});
      return;
    }
    const Vec3 center = local(cell, sum / static_cast<double>(loop.size()));
    const ContourId apex = add_inner(cell, VoxelPatch(c).surface_point_near(center), label);
    ContourId previous = loop.back();
    for (const ContourId v : loop) {
      mesh_.triangles.push_back({previous, v, apex});
      previous = v;
    }
  }

  // Makes a band between the loops, one forwards and the other backwards, cut along the shortest
  // chords between them. Chords get a point of Sigma in the middle. So the band follows the neck,
  // and no chord lies in a face, where the voxel across might have the same chord.
  void tube(const CellFrame& cell, const Corners& c, std::span<const ContourId> a,
            std::span<const ContourId> b, std::uint32_t label) {
    for (const ContourId v : a) mesh_.component[v] = label;
    for (const ContourId v : b) mesh_.component[v] = label;
    const VoxelPatch patch(c);
    const std::size_t n = a.size(), m = b.size();
    const auto forwards = [&](std::size_t i) { return a[i % n]; };
    const auto backwards = [&](std::size_t j) { return b[(2 * m - j) % m]; };
    const auto chord2 = [&](std::size_t i, std::size_t j) {
      return distance2(local(cell, forwards(i)), local(cell, backwards(j)));
    };
    std::size_t i = 0, j = 0;
    for (std::size_t at = 0; at < n * m; ++at) {
      if (chord2(at / m, at % m) < chord2(i, j)) i = at / m, j = at % m;
    }
    const auto middle = [&] {
      const Vec3 p = 0.5 * (local(cell, forwards(i)) + local(cell, backwards(j)));
      return add_inner(cell, patch.surface_point_near(p), label);
    };
    const std::size_t i_end = i + n, j_end = j + m;
    const ContourId start = middle();
    ContourId ring = start;
    while (i < i_end || j < j_end) {
      const bool along_a = j == j_end || (i < i_end && chord2(i + 1, j) <= chord2(i, j + 1));
      const ContourId p = forwards(i), q = backwards(j);
      ++(along_a ? i : j);
      const ContourId next = i == i_end && j == j_end ? start : middle();
      if (along_a) {
        mesh_.triangles.push_back({p, forwards(i), next});
        mesh_.triangles.push_back({p, next, ring});
        mesh_.triangles.push_back({ring, next, q});
      } else {
        mesh_.triangles.push_back({backwards(j), q, ring});
        mesh_.triangles.push_back({backwards(j), ring, next});
        mesh_.triangles.push_back({ring, p, next});
      }
      ring = next;
    }
  }

  ContourId add_inner(const CellFrame& cell, const Vec3& u, std::uint32_t label) {
    return add_at(cell.low + times(u, cell.size), 0, label);
  }

  // Return coordinates in the cell.
  Vec3 local(const CellFrame& cell, ContourId v) const { return local(cell, mesh_.points[v]); }
  Vec3 local(const CellFrame& cell, const Vec3& p) const {
    return divided(volume_.in_all_samples(p) - cell.low, cell.size);
  }
  Vec3 sides_of(const CellFrame& cell) const {
    return volume_.is_even()
               ? times(cell.size, volume_.spacing())
               : volume_.at_samples(cell.low + cell.size) - volume_.at_samples(cell.low);
  }

  ContourMesh& mesh_;
  const Volume& volume_;
  const Box3 within_;  // of the volume
  double kappa_;
  Index3 dims_, first_;
  std::size_t first_triangle_ = 0;
};

}  // namespace deliso
