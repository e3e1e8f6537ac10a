// SPDX-License-Identifier: MIT
#include "blocks/patch.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/sorted_list.h"
#include "blocks/order.h"

namespace deliso {
namespace {

// The places of some ids of the whole in a list of them.
template <class Id>
class PlacesIn {
 public:
  explicit PlacesIn(std::span<const Id> list) {
    for (std::size_t n = 0; n < list.size(); ++n) places_.emplace_back(list[n], Id(n));
    std::ranges::sort(places_);
  }
  // Returns kNoId if it is not there.
  Id operator[](Id in_whole) const {
    const auto at = std::ranges::lower_bound(places_, in_whole, {}, &std::pair<Id, Id>::first);
    return at != places_.end() && at->first == in_whole ? at->second : Id(kNoId);
  }

 private:
  std::vector<std::pair<Id, Id>> places_;
};

// Returns for the elements of a patch, of which `ids` are those of the whole before, their ids in
// the whole. New ones get those of removed ones, then ids from `size` on, which is increased.
template <class Id, class IsUsed, class MayFree>
std::vector<Id> ids_in_whole(std::vector<Id> ids, std::size_t count, std::size_t& size,
                             IsUsed&& is_used, MayFree&& may_free) {
  const std::size_t old = ids.size();
  ids.resize(count, kNoId);
  std::size_t spare = 0;
  for (std::size_t n = old; n < count; ++n) {
    if (!is_used(n)) continue;
    while (spare < old && (is_used(spare) || !may_free(spare))) ++spare;
    ids[n] = spare < old ? ids[spare++] : Id(size++);
  }
  return ids;
}

// Makes the array longer; a whole mesh is too large to be doubled.
template <class Array>
void grow(Array& array, std::size_t size) {
  if (size > array.capacity()) array.reserve(size + size / 16);
  array.resize(size);
}

}  // namespace

void extract(const SurfaceMesh& whole, MeshPatch& patch, PlacesInPatches& places) {
  const auto holds = [&](VertexId v) { return places.of_vertex[v] == patch.place; };
  std::vector<VertexId>& vertices = patch.vertices;
  std::vector<VertexId> held;
  for (const FaceId f : patch.facets) {
    for (const VertexId v : whole.mesh.faces[f].v) {
      if (!holds(v)) {
        vertices.push_back(v);
      } else if (std::exchange(places.vertex[v], VertexId(0)) == kNoId) {
        held.push_back(v);
      }
    }
  }
  sort_unique(vertices);
  const auto place = [&](VertexId v) {
    return std::pair(by_place(whole.mesh.points[v]), v.number());
  };
  std::ranges::sort(vertices, {}, place);
  std::ranges::sort(held, {}, place);
  const PlacesIn<VertexId> outside(vertices);
  patch.first_held = VertexId(vertices.size());
  vertices.insert(vertices.end(), held.begin(), held.end());
  for (VertexId v = patch.first_held; v < vertices.size(); ++v) places.vertex[vertices[v]] = v;
  const auto local_vertex = [&](VertexId v) { return holds(v) ? places.vertex[v] : outside[v]; };

  IdArray<FaceId, Face> faces;
  faces.reserve(patch.facets.size());
  for (const FaceId f : patch.facets) {
    Face& face = faces.emplace_back(whole.mesh.faces[f]);
    for (VertexId& v : face.v) v = local_vertex(v);
    turn(face);
  }
  // A frozen facet has a vertex outside, so those come first.
  std::vector<FaceId> facets;
  SurfaceMesh& s = patch.mesh;
  facets.reserve(faces.size());
  s.mesh.faces.reserve(faces.size());
  s.duals.reserve(faces.size());
  patch.free_box.first_free = 0;
  for (const FaceId n : facet_order(faces, vertices.size())) {
    const FaceId f = patch.facets[n.number()], own(facets.size());
    facets.push_back(f);
    s.mesh.faces.push_back(faces[n]);
    s.duals.push_back(whole.duals[f]);
    if (faces[n].v[0] < patch.first_held) {
      ++patch.free_box.first_free;
    } else {
      places.facet[f] = own;
    }
  }
  patch.facets = std::move(facets);
  const PlacesIn<FaceId> frozen(
      std::span<const FaceId>(patch.facets).first(patch.free_box.first_free.number()));
  for (const VertexId v : vertices) s.mesh.points.push_back(whole.mesh.points[v]);
  for (Face& face : s.mesh.faces) {
    for (FaceId& g : face.n) {
      if (g != kNoId) g = places.of_facet[g] == patch.place ? places.facet[g] : frozen[g];
    }
  }
  // The ends of an open chain are their own neighbors.
  const BoundaryChain& chain = whole.chain;
  for (VertexId v = 0; v < patch.vertices.size(); ++v) {
    if (!chain.is_boundary(patch.vertices[v])) continue;
    const auto beside = [&](VertexId in_whole) {
      const VertexId u = local_vertex(in_whole);
      return u == kNoId ? v : u;
    };
    s.chain.set(v, beside(chain.previous(patch.vertices[v])), beside(chain.next(patch.vertices[v])),
                chain.place(patch.vertices[v]));
  }
}

std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch) {
  const TriMesh& part = patch.mesh.mesh;
  const BoundaryChain& chain = patch.mesh.chain;
  const std::size_t old_vertices = patch.vertices.size();
  const auto is_held = [&](VertexId v) { return v >= patch.first_held; };
  std::vector<std::uint8_t> is_used(part.points.size(), 0);
  for (const Face& face : part.faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) is_used[v] = 1;
  }
  std::size_t vertices = whole.mesh.points.size(), facets = whole.mesh.faces.size();
  const auto vertex = ids_in_whole(
      patch.vertices, part.points.size(), vertices, [&](std::size_t v) { return is_used[v] != 0; },
      [&](std::size_t v) { return is_held(VertexId(v)); });
  auto facet = ids_in_whole(
      patch.facets, part.faces.size(), facets,
      [&](std::size_t f) { return !is_dead(part.faces[FaceId(f)]); },
      [](std::size_t) { return true; });
  grow(whole.mesh.points, vertices);
  grow(whole.mesh.faces, facets);
  grow(whole.duals, facets);
  // Old ids first: new elements may have taken them.
  for (VertexId v = 0; v < old_vertices; ++v) {
    if (is_held(v) && whole.chain.is_boundary(vertex[v])) {
      whole.chain.set(vertex[v], kNoId, kNoId, {});
    }
  }
  for (VertexId v = 0; v < vertex.size(); ++v) {
    if (is_used[v] == 0) continue;
    // Chain vertices outside the free box are corners of frozen facets: their edges are as before.
    const bool may_change = is_held(v);
    whole.mesh.points[vertex[v]] = part.points[v];
    if (may_change && chain.is_boundary(v)) {
      whole.chain.set(vertex[v], vertex[chain.previous(v)], vertex[chain.next(v)], chain.place(v));
    }
  }
  for (FaceId f = patch.free_box.first_free; f < patch.facets.size(); ++f) {
    if (is_dead(part.faces[f])) whole.mesh.faces[facet[f]] = part.faces[f];
  }
  for (FaceId f = 0; f < facet.size(); ++f) {
    const Face& own = part.faces[f];
    if (is_dead(own)) continue;
    Face& face = whole.mesh.faces[facet[f]];
    if (f >= patch.free_box.first_free) {
      face = own;
      whole.duals[facet[f]] = patch.mesh.duals[f];
      for (VertexId& v : face.v) v = vertex[v];
    }
    // A frozen facet may have neighbors outside the patch, and begin with another vertex there.
    const int first = corner_index(face, vertex[own.v[0]]);
    for (int i = 0; i < 3; ++i) {
      if (own.n[i] != kNoId) face.n[(first + i) % 3] = facet[own.n[i]];
    }
  }
  return facet;
}

}  // namespace deliso
