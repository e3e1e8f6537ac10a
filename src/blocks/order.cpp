// SPDX-License-Identifier: MIT
#include "blocks/order.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "blocks/components.h"

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

std::vector<VertexId> vertex_order(const TriMesh& mesh, const BlockGrid& grid,
                                   const Volume& shape) {
  IdArray<VertexId, std::uint8_t> is_used(mesh.points.size(), 0);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) is_used[v] = 1;
  }
  std::vector<std::pair<std::size_t, VertexId>> in_cells;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (is_used[v] == 0) continue;
    in_cells.emplace_back(grid.number_of(grid.cell_of(shape.voxel_at(mesh.points[v]))), v);
  }
  std::ranges::sort(in_cells, {}, [&](const auto& item) {
    return std::tuple(item.first, by_place(mesh.points[item.second]), item.second.number());
  });
  std::vector<VertexId> order;
  for (const auto& [cell, v] : in_cells) order.push_back(v);
  return order;
}

}  // namespace

void order_by_place(Block& block, const BlockGrid& grid, const Volume& shape) {
  SurfaceMesh& s = block.mesh;
  TriMesh& mesh = s.mesh;
  const std::vector<VertexId> vertices = vertex_order(mesh, grid, shape);
  std::vector<VertexId> new_id(mesh.points.size(), kNoId);
  for (VertexId v = 0; v < vertices.size(); ++v) new_id[vertices[v.number()]] = v;
  mesh.points = in_order(mesh.points, vertices);
  block.may_thin = in_order(block.may_thin, vertices);
  s.chain = s.chain.renumbered(new_id);

  std::vector<FaceId> facets;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    for (VertexId& v : mesh.faces[f].v) v = new_id[v];
    turn(mesh.faces[f]);
    facets.push_back(f);
  }
  std::ranges::sort(facets, {}, [&](FaceId f) { return mesh.faces[f].v; });
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
