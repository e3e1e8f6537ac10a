// SPDX-License-Identifier: MIT
// Exercise 4, four hours: which voxels does a line cross that hold the surface?
//
// CollectVoxels of Figure 12 (§4.1). A volume has millions of voxels and a line crosses some
// hundreds, of which a few are active: their samples lie on both sides of kappa. A kd-tree finds
// these. Its root is the box of all voxels. A node's box is halved across an axis, and the children
// have the halves. A node knows the least and greatest of its samples. If both lie on one side of
// kappa, nothing below it is active, and the line need not be followed there.
//
// Call visit(span) for the active voxels along `range` of the line, in order, each with its piece.
//
// The tree (kdtree/voxel_tree.h). `std::get<Nodes<T>>(nodes_)` is an array with the root in [1] and
// the children of n in [2 n], the lower half, and [2 n + 1]. nodes[n].active(threshold) is the
// test. The root is of level 0, and nodes of level depth_ are leaves, bricks of a hundred voxels.
// Of a node of level k with the box `box` (box.lo <= voxel < box.hi; the root's is `box()`), the
// axis is axis_[k], and the halves meet at the plane
//   middle = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2.
//
// The line (isosurface/lattice_line.h). line.at_plane(axis, middle) is the t at which it crosses
// that plane; it may be infinite. line.ahead(axis) is 1 if the line goes up that axis, and then
// the lower child comes first; else it is 0. Let t0 < t1 be the piece of the line in the node. If
// t <= t0, all of it is in the second child. If t >= t1, all of it is in the first. Else it is cut
// at t. No epsilon: every voxel's own piece is computed from the same planes by the same formula,
// so the comparisons agree to the last bit.
//
// In a leaf walk from voxel to voxel:
//   for (VoxelWalk walk(line, line.voxel_after(t0, box), {t0, t1}); !walk.done(); walk.step())
// with walk.voxel() and walk.span(). is_active_voxel(s, dy, dz, threshold) (volume/volume.h) tells
// whether the voxel is active whose first sample is at s = samples + volume_.index(i, j, k); dy and
// dz are the distances in the array between samples along y and z: dims().i and dims().i * dims().j
// of volume_.
//
// If `visit` takes a box, too, the tests count what you look at: call it with the box of each
// active node that you go into, leaves as well:
//   if constexpr (std::is_invocable_v<Visit&, const VoxelBox&>) visit(box);
//
// Where range.lo < range.hi does not hold there is nothing to do.
//
// Hint: recursion is simplest: a lambda that takes itself, the node, its level, its box, t0 and t1.
// It is not slow, for the depth is some twenty.
template <class T, class Visit>
void VoxelTree::find_along(const LatticeLine& line, Range range, const T* samples, T threshold,
                           Visit&& visit) const {
  throw std::logic_error("exercise 4: your work");
}
