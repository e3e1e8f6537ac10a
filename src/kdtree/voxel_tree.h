// SPDX-License-Identifier: MIT
// The min/max kd-tree over the voxels of a volume (paper §4.1; Havran 2000 for the traversal, Wald
// et al. 2005 for the implicit tree with ranges).
//
// A perfect binary tree in an array, with the children of n at 2n and 2n+1. A node holds only the
// smallest and largest sample at its voxels' corners, in the volume's own sample type.
//   K1  All nodes of a level split across the same axis, the longest there, in the middle on a
//       voxel boundary. The sides of a level's nodes differ by at most one voxel.
//   K2  A leaf is a brick of at most kLeafVoxels voxels, and of more than about half as many if
//       there are enough to split. With two nodes a leaf and two samples a node, the tree takes
//       some 3 to 7 % of the volume's bytes.
//   K3  A node's range covers every sample at a corner of its voxels, shared faces included.
//   K4  A node or voxel is active for kappa if it has samples both >= kappa and < kappa. (The paper
//       prunes by kappa_min <= kappa <= kappa_max; inside is >= kappa, so min < kappa.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/segment.h"
#include "isosurface/lattice_line.h"
#include "volume/volume.h"

namespace deliso {

class VoxelTree {
 public:
  static constexpr int kLeafVoxels = 128;

  // Reads every sample once. Keeps a reference to the volume, which must outlive the tree.
  explicit VoxelTree(const Volume& volume);

  const Volume& volume() const { return volume_; }
  VoxelBox box() const { return units_.box(); }
  // True if any voxel is active.
  bool active(double kappa) const;
  std::size_t bytes() const;
  int depth() const { return depth_; }

  // Finds the active voxels that r crosses, in order, each with its piece of r (t in [0, 1]):
  // CollectVoxels of Figure 12. Voxels that r touches only in a point are left out. A segment in a
  // face shared by two voxels is in one of them. Replaces the contents of `spans`.
  void collect_voxels(const Segment& r, double kappa, std::vector<VoxelSpan>& spans) const;

  // Calls visit(span) for the active voxels along `range` of the line, in order. T is the volume's
  // sample type.
  // pre: `range` is line.clip() or a part of it; `samples` are the volume's; active(kappa);
  // threshold == inside_threshold<T>(kappa).
  // If `visit` also takes a VoxelBox, it is told the box of each node whose children or voxels the
  // search looks at: the cost of a search.
  template <class T, class Visit>
  void find_along(const LatticeLine& line, Range range, const T* samples, T threshold,
                  Visit&& visit) const;

  // Returns the line origin + t * direction (scaled frame) in voxel units, with the same t.
  LatticeLine lattice_line(const Vec3& origin, const Vec3& direction) const {
    return units_.line(origin, direction);
  }

 private:
  template <class T>
  struct MinMax {
    T min, max;
    bool active(T threshold) const { return min < threshold && max >= threshold; }
  };
  template <class T>
  using Nodes = std::vector<MinMax<T>>;

  // A node still to be searched. A level pushes at most one, and an axis of fewer than 2^31 voxels
  // is halved at most 31 times. So the stack cannot overflow.
  struct Pending {
    std::size_t node;
    int level;
    VoxelBox box;
    double t0, t1;
  };
  static constexpr int kMaxDepth = 3 * 31;
  static_assert(std::numeric_limits<int>::digits <= 31);

  template <class T>
  void build(const T* samples);
  void choose_axes();

  const Volume& volume_;
  VoxelUnits units_;
  int depth_ = 0;                               // levels of inner nodes
  std::array<std::uint8_t, kMaxDepth> axis_{};  // the axis across which each level splits
  std::variant<Nodes<std::uint8_t>, Nodes<std::int8_t>, Nodes<std::uint16_t>, Nodes<std::int16_t>,
               Nodes<std::uint32_t>, Nodes<std::int32_t>, Nodes<float>, Nodes<double>>
      nodes_;  // [0] unused, [1] the root
};

template <class T, class Visit>
void VoxelTree::find_along(const LatticeLine& line, Range range, const T* samples, T threshold,
                           Visit&& visit) const {
  if (!(range.lo < range.hi)) return;
  const auto& nodes = std::get<Nodes<T>>(nodes_);
  const std::size_t dy = volume_.dims().i, dz = dy * volume_.dims().j;

  std::array<Pending, kMaxDepth> stack;
  std::size_t waiting = 0;
  Pending at{1, 0, box(), range.lo, range.hi};
  while (true) {
    const bool active = nodes[at.node].active(threshold);
    if constexpr (std::is_invocable_v<Visit&, const VoxelBox&>) {
      if (active) visit(at.box);
    }
    if (active && at.level < depth_) {
      // Go to the child that comes first along the line; the other one waits. The crossing of the
      // split plane is compared exactly as in a voxel walk.
      const std::size_t axis = axis_[at.level];
      const int middle = at.box.lo[axis] + (at.box.hi[axis] - at.box.lo[axis]) / 2;
      const double split = line.at_plane(axis, middle);
      const auto descend = [&](Pending& node, int upper) {
        node.node = 2 * node.node + static_cast<std::size_t>(upper);
        ++node.level;
        (upper ? node.box.lo : node.box.hi)[axis] = middle;
      };
      const int second = line.ahead(axis);
      if (split <= at.t0) {
        descend(at, second);
      } else if (split >= at.t1) {
        descend(at, 1 - second);
      } else {
        Pending& later = stack[waiting++];
        later = at;
        later.t0 = at.t1 = split;
        descend(later, second);
        descend(at, 1 - second);
      }
      continue;
    }
    if (active) {
      const Index3 first = line.voxel_after(at.t0, at.box);
      for (VoxelWalk walk(line, first, {at.t0, at.t1}); !walk.done(); walk.step()) {
        const Index3 v = walk.voxel();
        if (is_active_voxel(samples + volume_.index(v.i, v.j, v.k), dy, dz, threshold)) {
          visit(walk.span());
        }
      }
    }
    if (waiting == 0) return;
    at = stack[--waiting];
  }
}

}  // namespace deliso
