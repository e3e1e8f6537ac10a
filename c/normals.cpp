// SPDX-License-Identifier: MIT
#include "c/normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/mesh_attributes.h"
#include "base/parallel.h"
#include "blocks/grid.h"
#include "blocks/mesh_in_blocks.h"
#include "volume/volume.h"

namespace deliso::c {
namespace {

// Returns the unit vector at p, in the world. `around`: the samples near p; `box`: of all samples.
Vec3 normal_at(const Vec3& p, const Volume& around, const Box3& box) {
  Vec3 falls;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = around.sides(around.voxel_at(p))[axis] / 2;
    Vec3 low = p, high = p;
    low[axis] = std::max(p[axis] - half, box.lo[axis]);
    high[axis] = std::min(p[axis] + half, box.hi[axis]);
    falls[axis] = (around.value(low) - around.value(high)) / (high[axis] - low[axis]);
  }
  const double largest = std::max({std::fabs(falls.x), std::fabs(falls.y), std::fabs(falls.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  falls = normal_in_world(falls / largest, around.frame());  // so that no square overflows
  return falls / length(falls);
}

}  // namespace

std::vector<Vec3> normals_of(const TriMesh& mesh, const VolumeSource& field,
                             const Options& options) {
  const BlockGrid grid = block_grid(field.shape, options);
  const std::vector<SampleBox> boxes = grid.boxes();
  std::vector<std::vector<VertexId>> vertices(boxes.size());
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    vertices[grid.number_of(grid.cell_of(field.shape.voxel_at(mesh.points[v])))].push_back(v);
  }
  std::vector<Vec3> normals(mesh.points.size());
  for_each_task(options.threads, boxes.size(), [&](std::size_t n) {
    if (vertices[n].empty()) return;
    const Volume around = field.read(grown(boxes[n], {1, 1, 1}, field.shape.voxels()));
    for (const VertexId v : vertices[n]) {
      normals[v] = normal_at(mesh.points[v], around, field.shape.box());
    }
  });
  return normals;
}

}  // namespace deliso::c
