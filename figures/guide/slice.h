// SPDX-License-Identifier: MIT
// A surface that can be drawn on paper: a volume of two equal layers of samples, so that Sigma
// stands upright on its outline. What the library says of such a volume, in a plane between the
// layers, is said of the outline, and nothing in a picture is drawn by any other rule.
#pragma once

#include <functional>
#include <vector>

#include "base/vec2.h"
#include "isosurface/isosurface.h"
#include "kdtree/voxel_tree.h"
#include "volume/volume.h"

namespace deliso::guide {

class Slice {
 public:
  // Samples of f at (0, 0) .. (columns - 1, rows - 1); inside is f >= 0, and no sample is 0.
  // The outline is drawn in `cells` steps a voxel.
  Slice(int columns, int rows, const std::function<double(double, double)>& f, int cells = 8);
  Slice(const Slice&) = delete;

  const Volume& volume() const { return volume_; }
  const VoxelTree& tree() const { return tree_; }
  const Isosurface& surface() const { return surface_; }

  // The outline as the exact contour has it in such cells, loop by loop.
  // pre: no loop comes to the sides of the volume.
  const std::vector<std::vector<Vec2>>& loops() const { return loops_; }
  // Where a straight way from a to b meets Sigma, in order.
  std::vector<Vec2> hits(const Vec2& a, const Vec2& b) const;

  // The layers are far apart, so that tall triangles stand upright on a line of the paper.
  static constexpr double kLayers = 100, kHeight = 50;
  static Vec3 lifted(const Vec2& p) { return {p.x, p.y, kHeight}; }

 private:
  Volume volume_;
  VoxelTree tree_;
  Isosurface surface_;
  std::vector<std::vector<Vec2>> loops_;
};

}  // namespace deliso::guide
