// SPDX-License-Identifier: MIT
#include "blocks/patch.h"

#include <algorithm>
#include <iterator>

#include "base/sorted_list.h"

namespace deliso {
namespace {

// Returns the place of `id` in the ascending `ids`; kNoId if it is not there.
template <class Id>
Id place_in(std::span<const Id> ids, Id id) {
  const auto at = std::ranges::lower_bound(ids, id);
  return at != ids.end() && *at == id ? Id(at - ids.begin()) : Id(kNoId);
}

// Returns `ids` and, for new elements, ids after the last.
template <class Id>
std::vector<Id> extended(std::vector<Id> ids, std::size_t size, std::size_t last) {
  while (ids.size() < size) ids.emplace_back(last++);
  return ids;
}

}  // namespace

std::vector<VertexId> vertices_of(const TriMesh& mesh, std::span<const FaceId> facets) {
  std::vector<VertexId> vertices;
  for (const FaceId f : facets) std::ranges::copy(mesh.faces[f].v, std::back_inserter(vertices));
  sort_unique(vertices);
  return vertices;
}

void extract(const SurfaceMesh& whole, MeshPatch& patch) {
  const std::span<const FaceId> facets = patch.facets;
  const std::span<const FaceId> frozen = facets.first(patch.region.first_free);
  const std::span<const FaceId> free = facets.subspan(frozen.size());
  const auto local_facet = [&](FaceId f) {
    if (f == kNoId) return f;
    const FaceId at = place_in(frozen, f);
    if (at != kNoId) return at;
    const FaceId after = place_in(free, f);
    return after == kNoId ? after : FaceId(frozen.size() + after);
  };
  const std::span<const VertexId> vertices = patch.vertices;
  SurfaceMesh& s = patch.mesh;
  for (const VertexId v : vertices) s.mesh.points.push_back(whole.mesh.points[v]);
  for (const FaceId f : facets) {
    Face& face = s.mesh.faces.emplace_back(whole.mesh.faces[f]);
    for (VertexId& v : face.v) v = place_in(vertices, v);
    for (FaceId& g : face.n) g = local_facet(g);
    s.duals.push_back(whole.duals[f]);
  }
  for (VertexId v = 0; v < vertices.size(); ++v) {
    const BoundaryChain& chain = whole.chain;
    if (!chain.is_boundary(vertices[v])) continue;
    const VertexId before = place_in(vertices, chain.previous(vertices[v]));
    const VertexId next = place_in(vertices, chain.next(vertices[v]));
    s.chain.set(v, before == kNoId ? v : before, next == kNoId ? v : next,
                chain.place(vertices[v]));
  }
}

std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch) {
  const SurfaceMesh& s = patch.mesh;
  const std::size_t old_vertices = patch.vertices.size();
  const auto vertex = extended(patch.vertices, s.mesh.points.size(), whole.mesh.points.size());
  const auto facet = extended(patch.facets, s.mesh.faces.size(), whole.mesh.faces.size());
  whole.mesh.points.resize(whole.mesh.points.size() + vertex.size() - old_vertices);
  whole.mesh.faces.resize(whole.mesh.faces.size() + facet.size() - patch.facets.size());
  whole.duals.resize(whole.mesh.faces.size());
  for (VertexId v = 0; v < vertex.size(); ++v) {
    whole.mesh.points[vertex[v]] = s.mesh.points[v];
    // Chain vertices outside the region are corners of frozen facets: their edges are as before.
    if (v < old_vertices && !patch.region.holds(s.mesh.points[v])) continue;
    if (s.chain.is_boundary(v)) {
      whole.chain.set(vertex[v], vertex[s.chain.previous(v)], vertex[s.chain.next(v)],
                      s.chain.place(v));
    } else if (whole.chain.is_boundary(vertex[v])) {
      whole.chain.set(vertex[v], kNoId, kNoId, {});
    }
  }
  for (FaceId f = 0; f < facet.size(); ++f) {
    Face& face = whole.mesh.faces[facet[f]];
    const Face& own = s.mesh.faces[f];
    const bool is_frozen = f < patch.region.first_free;
    if (!is_frozen) {
      face = own;
      whole.duals[facet[f]] = s.duals[f];
      if (is_dead(own)) continue;
      for (VertexId& v : face.v) v = vertex[v];
    }
    // A frozen facet may have neighbors outside the patch.
    for (int i = 0; i < 3; ++i) {
      if (own.n[i] != kNoId) face.n[i] = facet[own.n[i]];
    }
  }
  return facet;
}

}  // namespace deliso
