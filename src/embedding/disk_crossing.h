// SPDX-License-Identifier: MIT
// Tests exactly whether a disk of facets crosses itself or other facets of a mesh. One plane
// separates nearly every facet near the disk from all of it, which costs a few products for each
// corner. Only the other facets need the exact predicates (embedding/triangle_pair.h).
//
// A plane separates a facet if the facet's corners lie outside of it and the whole disk inside,
// except corners that both share. Planes are tested with a margin far above rounding, so a
// separated facet never crosses. Those of the whole disk are tested side by side in single
// precision, those of a pair of facets one by one in double.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "mesh/disk.h"

namespace deliso {

class DiskCrossing {
 public:
  // Prepares the tests of `disk`, which is linked, until the next call: keeps the pointers.
  // `points` are the mesh's, `normals` the disk's area normals. Returns false if a facet has no
  // area.
  bool begin(const std::vector<Vec3>& points, const Disk& disk, std::span<const Vec3> normals,
             const BoxGrid& grid);

  // Returns the boxes of the disk's facets, in the grid's units.
  std::span<const BoxGrid::Box> boxes() const { return boxes_; }
  // Returns the box around all of them.
  BoxGrid::Box box() const;
  // True if two facets of the disk cross. `apex`: a vertex that all facets share, or kNoId.
  bool crosses_itself(VertexId apex) const;
  // True if a facet of the disk crosses t, another facet of the mesh, whose box is `box`.
  bool crosses(const Triangle& t, const BoxGrid::Box& box);

 private:
  // Sets the planes of the disk that have all of it inside.
  void set_planes();
  // Returns the planes that v lies outside of (sign 1) or inside (-1), by the margin.
  std::uint32_t planes_with(VertexId v, float sign) const;
  // Returns the planes that v lies outside of or on whose side it is: bit n for plane n.
  std::uint32_t planes_with_outside(VertexId v);
  bool is_fan(VertexId apex) const;
  bool meet(std::size_t f, const Triangle& t) const;
  const Vec3& point(VertexId v) const { return (*points_)[v]; }

  const std::vector<Vec3>* points_ = nullptr;
  const Disk* disk_ = nullptr;
  std::span<const Vec3> normals_;
  std::vector<BoxGrid::Box> boxes_;
  // The planes through the disk's boundary edges, in a frame in which the disk is at the origin and
  // about as large as one: x of them all, y of them all and so on. A place without a plane has no
  // inside and no outside.
  static constexpr std::size_t kMaxPlanes = 32;  // the bits of Known::planes
  static constexpr std::size_t kLanes = 4;
  using Four [[gnu::vector_size(kLanes * sizeof(float))]] = float;
  using Bits [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;
  struct Planes {
    Four x, y, z, offset, margin;
  };
  std::array<Planes, kMaxPlanes / kLanes> planes_;
  std::size_t used_ = 0;          // of planes_
  std::uint32_t separating_ = 0;  // planes with the whole disk inside
  Vec3 center_;
  double scale_ = 0;
  // Per vertex of the mesh: planes_with_outside, if `stamp` is that of the current disk.
  struct Known {
    std::uint32_t stamp = 0, planes = 0;
  };
  std::vector<Known> known_;
  std::uint32_t stamp_ = 0;
};

}  // namespace deliso
