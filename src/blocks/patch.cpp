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

void extract(const SurfaceMesh& whole, MeshPatch& patch, PlacesInPatches& places) {
  const auto holds = [&](VertexId v) { return patch.region.holds(whole.mesh.points[v]); };
  const std::span<const FaceId> frozen =
      std::span(patch.facets).first(patch.region.first_free);
  std::vector<VertexId> held;
  for (FaceId f = 0; f < patch.facets.size(); ++f) {
    if (f >= frozen.size()) places.facet[patch.facets[f]] = f;
    for (const VertexId v : whole.mesh.faces[patch.facets[f]].v) {
      (holds(v) ? held : patch.vertices).push_back(v);
    }
  }
  sort_unique(patch.vertices);
  const std::vector<VertexId> outside = patch.vertices;
  for (const VertexId v : held) places.vertex[v] = kNoId;
  for (const VertexId v : held) {
    if (places.vertex[v] != kNoId) continue;
    places.vertex[v] = VertexId(patch.vertices.size());
    patch.vertices.push_back(v);
  }
  const auto local_vertex = [&](VertexId v) {
    return holds(v) ? places.vertex[v] : place_in(std::span<const VertexId>(outside), v);
  };
  const auto is_free = [&](FaceId f) { return std::ranges::all_of(whole.mesh.faces[f].v, holds); };
  const auto local_facet = [&](FaceId f) {
    return f == kNoId ? f : is_free(f) ? places.facet[f] : place_in(frozen, f);
  };
  SurfaceMesh& s = patch.mesh;
  for (const VertexId v : patch.vertices) s.mesh.points.push_back(whole.mesh.points[v]);
  for (const FaceId f : patch.facets) {
    Face& face = s.mesh.faces.emplace_back(whole.mesh.faces[f]);
    for (VertexId& v : face.v) v = local_vertex(v);
    for (FaceId& g : face.n) g = local_facet(g);
    s.duals.push_back(whole.duals[f]);
  }
  // The ends of an open chain are their own neighbors.
  const BoundaryChain& chain = whole.chain;
  for (VertexId v = 0; v < patch.vertices.size(); ++v) {
    if (!chain.is_boundary(patch.vertices[v])) continue;
    const auto beside = [&](VertexId in_whole) {
      const VertexId u = local_vertex(in_whole);
      return u == kNoId ? v : u;
    };
    s.chain.set(v, beside(chain.previous(patch.vertices[v])),
                beside(chain.next(patch.vertices[v])), chain.place(patch.vertices[v]));
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
