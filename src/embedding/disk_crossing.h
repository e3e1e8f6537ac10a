// SPDX-License-Identifier: MIT
// Whether a disk of facets crosses itself or other facets of a mesh, exactly. Nearly every facet
// near the disk is separated from all of it by one plane, which costs a few products for each
// corner; only what is left is tested by the exact predicates (embedding/triangle_pair.h).
//
// A facet is separated when all its corners lie beyond a plane that the whole disk lies before, but
// for corners that both share. Planes are tested with a margin far above rounding, so a separated
// facet never crosses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "mesh/disk.h"

namespace deliso {

class DiskCrossing {
 public:
  // Looks at `disk`, which is linked, until the next call: keeps the pointers. `points` are the
  // mesh's, `normals` the disk's area normals. False if a facet has no area.
  bool begin(const std::vector<Vec3>& points, const Disk& disk, std::span<const Vec3> normals,
             const BoxGrid& grid);

  // The boxes of the disk's facets, in the grid's units.
  std::span<const BoxGrid::Box> boxes() const { return boxes_; }
  // Around all of them.
  BoxGrid::Box box() const;
  // True if two facets of the disk cross. `apex`: a vertex that all of them share, or kNoId.
  bool crosses_itself(VertexId apex) const;
  // True if a facet of the disk crosses t, another facet of the mesh, whose box is `box`.
  bool crosses(const Triangle& t, const BoxGrid::Box& box);

 private:
  // A plane through a side of a facet, upright on that facet.
  struct Plane {
    VertexId from, to;
    Vec3 origin, outwards;
    double margin;
  };
  Plane upright(const Triangle& t, const Vec3& normal, int side) const;
  // Sign 1: v lies beyond the plane; -1: before it.
  bool is_off(const Plane& plane, VertexId v, double sign) const;
  // True if the plane separates a triangle, whose third corner is `inside`, from another one.
  bool separates(const Plane& plane, VertexId inside, const Triangle& other) const;
  std::uint32_t planes_before(VertexId v);
  bool is_fan(VertexId apex) const;
  bool meet(std::size_t f, const Triangle& t) const;
  const Vec3& point(VertexId v) const { return (*points_)[v]; }

  const std::vector<Vec3>* points_ = nullptr;
  const Disk* disk_ = nullptr;
  std::span<const Vec3> normals_;
  std::vector<BoxGrid::Box> boxes_;
  static constexpr std::size_t kMaxPlanes = 32;  // the bits of Known::planes
  std::vector<Plane> planes_;                    // with the whole disk before them
  // Per vertex of the mesh, bit n: it lies beyond plane n or on the side that the plane is through.
  struct Known {
    std::uint32_t stamp = 0, planes = 0;
  };
  std::vector<Known> known_;
  std::uint32_t stamp_ = 0;
};

}  // namespace deliso
