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

// Returns the array with the elements in the order of their old ids.
template <class Id, class T>
IdArray<Id, T> in_order(const IdArray<Id, T>& old, const std::vector<Id>& order) {
  if (old.empty()) return {};
  IdArray<Id, T> ordered;
  ordered.reserve(order.size());
  for (const Id n : order) ordered.push_back(old[n]);
  return ordered;
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
  mesh.points = in_order(mesh.points, vertices);
  block.may_thin = in_order(block.may_thin, vertices);
  s.chain = s.chain.renumbered(new_id);

  for (Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (VertexId& v : face.v) v = new_id[v];
    turn(face);
  }
  const std::vector<FaceId> facets = facet_order(mesh.faces, mesh.points.size());
  IdArray<FaceId, FaceId> new_face(mesh.faces.size(), kNoId);
  for (FaceId f = 0; f < facets.size(); ++f) new_face[facets[f.number()]] = f;
  mesh.faces = in_order(mesh.faces, facets);
  for (Face& face : mesh.faces) {
    for (FaceId& g : face.n) {
      if (g != kNoId) g = new_face[g];
    }
  }
  s.duals = in_order(s.duals, facets);
  block.is_open = in_order(block.is_open, facets);
}

}  // namespace deliso
