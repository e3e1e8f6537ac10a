// SPDX-License-Identifier: MIT
#include "contour/slabs.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace deliso {

std::vector<SlabNumbers> weld(std::vector<SlabWalk>& walks,
                              const std::vector<std::size_t>& vertices) {
  std::vector<SlabNumbers> numbers(walks.size());
  SlabWalk& all = walks[0];
  numbers[0].end = VertexId(vertices[0]);
  std::vector<SharedCrossing> above = std::move(all.above);
  for (std::size_t n = 1; n < walks.size(); ++n) {
    SlabWalk& walk = walks[n];
    const SlabNumbers& before = numbers[n - 1];
    SlabNumbers& now = numbers[n];
    now.offset = all.components.append(walk.components);
    DELISO_CHECK(walk.below.size() == above.size());
    for (std::size_t c = 0; c < above.size(); ++c) {
      if (walk.below[c].vertex != kNoId) now.shared.push_back(before.of(above[c].vertex));
      const std::uint32_t root =
          all.components.unite(all.components.root(before.offset + above[c].label),
                               all.components.root(now.offset + walk.below[c].label));
      --all.components.counts(root).crossings;  // counted by both
    }
    const std::size_t own = vertices[n] - now.shared.size();
    if (own >= kNoId - before.end) throw InputError("the contour has 2^32 vertices or more");
    now.first = before.end;
    now.end = VertexId(now.first + own);
    for (const BoundarySegment& s : walk.boundary) {
      all.boundary.push_back({now.of(s.from), now.of(s.to), now.offset + s.component, s.face});
    }
    all.active_voxels += walk.active_voxels;
    above = std::move(walk.above);
  }
  return numbers;
}

ContourMesh weld(std::vector<ContourMesh> parts, const std::vector<SlabNumbers>& numbers,
                 int threads) {
  if (parts.size() == 1) return std::move(parts[0]);
  ContourMesh mesh;
  std::vector<std::size_t> first_triangle{0};
  for (const ContourMesh& part : parts) {
    const std::size_t raised = first_triangle.back();
    for (const ContourMesh::VoxelTriangles& crowd : part.crowded) {
      mesh.crowded.push_back({crowd.voxel, raised + crowd.first, raised + crowd.end});
    }
    first_triangle.push_back(raised + part.triangles.size());
  }
  mesh.points.resize(numbers.back().end);
  mesh.component.resize(mesh.points.size());
  mesh.box_faces.resize(mesh.points.size());
  mesh.triangles.resize(first_triangle.back());
  for_each_task(threads, parts.size(), [&](std::size_t n) {
    const ContourMesh part = std::move(parts[n]);
    const SlabNumbers& now = numbers[n];
    const auto shared = static_cast<std::ptrdiff_t>(now.shared.size());
    const auto first = static_cast<std::ptrdiff_t>(now.first);
    std::copy(part.points.begin() + shared, part.points.end(), mesh.points.begin() + first);
    std::transform(part.component.begin() + shared, part.component.end(),
                   mesh.component.begin() + first,
                   [&](std::uint32_t label) { return now.offset + label; });
    std::copy(part.box_faces.begin() + shared, part.box_faces.end(),
              mesh.box_faces.begin() + first);
    std::transform(part.triangles.begin(), part.triangles.end(),
                   mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first_triangle[n]),
                   [&](const std::array<VertexId, 3>& t) {
                     return std::array{now.of(t[0]), now.of(t[1]), now.of(t[2])};
                   });
  });
  return mesh;
}

}  // namespace deliso
