// SPDX-License-Identifier: MIT
#include "contour/block_order.h"

#include <utility>

#include "base/parallel.h"

namespace deliso {
namespace {

constexpr int kBlockVoxels = 8;

// Number of items in one task.
constexpr std::size_t kItemsPerTask = 1 << 16;

// Returns the place of each item after a stable counting sort by key.
std::vector<std::uint32_t> places(const std::vector<std::uint32_t>& keys, std::size_t key_count) {
  std::vector<std::uint32_t> first(key_count + 1, 0);
  for (const std::uint32_t key : keys) ++first[key + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<std::uint32_t> place(keys.size());
  for (std::size_t n = 0; n < keys.size(); ++n) place[n] = first[keys[n]]++;
  return place;
}

template <class T>
void move_to(std::vector<T>& items, const std::vector<std::uint32_t>& place, int threads) {
  std::vector<T> moved(items.size());
  for_each_run(threads, items.size(), kItemsPerTask, [&](std::size_t n, std::size_t end) {
    for (; n < end; ++n) moved[place[n]] = items[n];
  });
  items = std::move(moved);
}

}  // namespace

void order_by_blocks(ContourMesh& contour, const Volume& volume, int threads) {
  const Index3 last = volume.voxels();
  const auto blocks = [](int voxels) {
    return static_cast<std::uint32_t>(voxels / kBlockVoxels + 1);
  };
  const std::uint32_t nx = blocks(last.i), ny = blocks(last.j), nz = blocks(last.k);

  std::vector<std::uint32_t> block(contour.points.size());
  for_each_run(threads, block.size(), kItemsPerTask, [&](std::size_t n, std::size_t end) {
    for (; n < end; ++n) {
      const Index3 v = volume.voxel_at(contour.points[n]);
      const auto at = [](int axis) { return static_cast<std::uint32_t>(axis / kBlockVoxels); };
      block[n] = at(v.i) + nx * (at(v.j) + ny * at(v.k));
    }
  });
  const std::size_t block_count = std::size_t{nx} * ny * nz;
  const std::vector<std::uint32_t> place = places(block, block_count);

  std::vector<std::uint32_t> triangle_block(contour.triangles.size());
  for_each_run(threads, triangle_block.size(), kItemsPerTask, [&](std::size_t n, std::size_t end) {
    for (; n < end; ++n) {
      std::array<VertexId, 3>& triangle = contour.triangles[n];
      triangle_block[n] = block[triangle[0]];
      for (VertexId& v : triangle) v = VertexId(place[v]);
    }
  });
  move_to(contour.triangles, places(triangle_block, block_count), threads);
  move_to(contour.points, place, threads);
  move_to(contour.component, place, threads);
  move_to(contour.box_faces, place, threads);
  for (VertexId& v : contour.boundary.vertices) v = VertexId(place[v]);
}

}  // namespace deliso
