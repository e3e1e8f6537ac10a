// SPDX-License-Identifier: MIT
#include "blocks/order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace deliso {
namespace {

// Moves each element to its new id; kNoId: it goes. In place, as a whole mesh is too large to have
// twice. pre: the new ids are those below `count`.
template <class Id, class T>
void renumber(IdArray<Id, T>& values, const std::vector<Id>& new_id, std::size_t count) {
  if (values.empty()) return;
  std::vector<std::uint8_t> has_left(values.size(), 0);
  for (std::size_t first = 0; first < values.size(); ++first) {
    T value = values[Id(first)];
    // Each element that makes room for another is the next to be moved.
    for (Id old(first); has_left[old] == 0 && new_id[old] != kNoId;) {
      has_left[old] = 1;
      old = new_id[old];
      std::swap(value, values[old]);
    }
  }
  values.resize(count);
}

std::vector<VertexId> vertex_order(const TriMesh& mesh, const BlockGrid& grid, const Grid& shape,
                                   int threads) {
  const IdArray<VertexId, std::uint8_t> is_used = mesh.used_vertices();
  const Index3 cells = grid.cells();
  std::vector<std::vector<VertexId>> of_cell(std::size_t(cells.i) * cells.j * cells.k);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (is_used[v] == 0) continue;
    of_cell[grid.number_of(grid.cell_of(shape.voxel_at(mesh.points[v])))].push_back(v);
  }
  for_each_task(threads, of_cell.size(), [&](std::size_t n) {
    std::ranges::sort(of_cell[n], {},
                      [&](VertexId v) { return std::pair(by_place(mesh.points[v]), v.number()); });
  });
  std::vector<VertexId> order;
  order.reserve(mesh.points.size());
  for (const std::vector<VertexId>& cell : of_cell) {
    order.insert(order.end(), cell.begin(), cell.end());
  }
  return order;
}

}  // namespace

std::vector<FaceId> facet_order(const IdArray<FaceId, Face>& faces, std::size_t vertices) {
  // Few have the same first vertex.
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  for (const Face& face : faces) {
    if (!is_dead(face)) ++begin[face.v[0] + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<FaceId> order(begin.back(), kNoId);
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (FaceId f = 0; f < faces.size(); ++f) {
    if (!is_dead(faces[f])) order[next[faces[f].v[0]]++] = f;
  }
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    std::ranges::sort(order.begin() + begin[v], order.begin() + begin[v + 1], {},
                      [&](FaceId f) { return faces[f].v; });
  }
  return order;
}

void order_by_place(Block& block, const BlockGrid& grid, const Grid& shape, int threads) {
  SurfaceMesh& s = block.mesh;
  TriMesh& mesh = s.mesh;
  const std::vector<VertexId> vertices = vertex_order(mesh, grid, shape, threads);
  std::vector<VertexId> new_id(mesh.points.size(), kNoId);
  for (VertexId v = 0; v < vertices.size(); ++v) new_id[vertices[v.number()]] = v;
  renumber(mesh.points, new_id, vertices.size());
  renumber(block.may_thin, new_id, vertices.size());
  s.chain = s.chain.renumbered(new_id);

  for (Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (VertexId& v : face.v) v = new_id[v];
    turn(face);
  }
  const std::vector<FaceId> facets = facet_order(mesh.faces, mesh.points.size());
  IdArray<FaceId, FaceId> new_face(mesh.faces.size(), kNoId);
  for (FaceId f = 0; f < facets.size(); ++f) new_face[facets[f.number()]] = f;
  renumber(mesh.faces, new_face, facets.size());
  for (Face& face : mesh.faces) {
    for (FaceId& g : face.n) {
      if (g != kNoId) g = new_face[g];
    }
  }
  renumber(s.duals, new_face, facets.size());
  renumber(block.is_open, new_face, facets.size());
}

}  // namespace deliso
