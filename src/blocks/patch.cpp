// SPDX-License-Identifier: MIT
#include "blocks/patch.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/sorted_list.h"
#include "blocks/order.h"

namespace deliso {
namespace {

// The numbers of a patch's elements in it, by their ids in the whole.
template <class Id>
class NumbersIn {
 public:
  // The elements from `held` on are those in the patch's free box.
  NumbersIn(std::span<const Id> ids, Id held, std::uint32_t place, Places<Id>& places)
      : place_(place), places_(places) {
    for (Id n = 0; n < held; ++n) outside_.emplace_back(ids[n], n);
    std::ranges::sort(outside_);
    for (Id n = held; n < ids.size(); ++n) places.number[ids[n]] = n;
  }
  // Returns kNoId if it is not there.
  Id operator[](Id in_whole) const {
    if (places_.of[in_whole] == place_) return places_.number[in_whole];
    const auto at = std::ranges::lower_bound(outside_, in_whole, {}, &std::pair<Id, Id>::first);
    return at != outside_.end() && at->first == in_whole ? at->second : Id(kNoId);
  }

 private:
  std::vector<std::pair<Id, Id>> outside_;
  std::uint32_t place_;
  const Places<Id>& places_;
};

// Sets the patch's vertices, those of its facets.
void list_vertices(const TriMesh& whole, MeshPatch& patch, Places<VertexId>& places) {
  std::vector<VertexId>&outside = patch.vertices, held;
  for (const FaceId f : patch.facets) {
    for (const VertexId v : whole.faces[f].v) {
      if (places.of[v] != patch.place) {
        outside.push_back(v);
      } else if (std::exchange(places.number[v], VertexId(0)) == kNoId) {
        held.push_back(v);
      }
    }
  }
  sort_unique(outside);
  const auto place = [&](VertexId v) { return std::pair(by_place(whole.points[v]), v.number()); };
  std::ranges::sort(outside, {}, place);
  std::ranges::sort(held, {}, place);
  patch.first_held = VertexId(outside.size());
  patch.vertices.insert(patch.vertices.end(), held.begin(), held.end());
}

// Returns for the elements of a patch, of which `ids` are those of the whole before, their ids in
// the whole. New ones get those of removed ones, then ids from `size` on, which is increased.
template <class Id, class IsUsed>
std::vector<Id> ids_in_whole(std::vector<Id> ids, std::size_t count, std::size_t& size,
                             IsUsed&& is_used) {
  const std::size_t old = ids.size();
  ids.resize(count, kNoId);
  std::size_t spare = 0;
  for (std::size_t n = old; n < count; ++n) {
    if (!is_used(Id(n))) continue;
    while (spare < old && is_used(Id(spare))) ++spare;
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
  list_vertices(whole.mesh, patch, places.vertices);
  const NumbersIn<VertexId> vertex(patch.vertices, patch.first_held, patch.place, places.vertices);
  IdArray<FaceId, Face> faces;
  faces.reserve(patch.facets.size());
  for (const FaceId f : patch.facets) {
    Face& face = faces.emplace_back(whole.mesh.faces[f]);
    for (VertexId& v : face.v) v = vertex[v];
    turn(face);
  }
  SurfaceMesh& s = patch.mesh;
  std::vector<FaceId> facets;
  facets.reserve(faces.size());
  s.mesh.faces.reserve(faces.size());
  s.duals.reserve(faces.size());
  for (const FaceId n : facet_order(faces, patch.vertices.size())) {
    facets.push_back(patch.facets[n]);
    s.mesh.faces.push_back(faces[n]);
    s.duals.push_back(whole.duals[facets.back()]);
    // A frozen facet has a vertex outside, so those come first.
    if (faces[n].v[0] < patch.first_held) patch.free_box.first_free = FaceId(facets.size());
  }
  patch.facets = std::move(facets);
  const NumbersIn<FaceId> facet(patch.facets, patch.free_box.first_free, patch.place,
                                places.facets);
  for (Face& face : s.mesh.faces) {
    for (FaceId& g : face.n) g = g == kNoId ? g : facet[g];
  }
  for (VertexId v = 0; v < patch.vertices.size(); ++v) {
    const VertexId in_whole = patch.vertices[v.number()];
    s.mesh.points.push_back(whole.mesh.points[in_whole]);
    if (!whole.chain.is_boundary(in_whole)) continue;
    // The ends of an open chain are their own neighbors.
    const VertexId previous = vertex[whole.chain.previous(in_whole)];
    const VertexId next = vertex[whole.chain.next(in_whole)];
    s.chain.set(v, previous == kNoId ? v : previous, next == kNoId ? v : next,
                whole.chain.place(in_whole));
  }
}

std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch) {
  const TriMesh& part = patch.mesh.mesh;
  const BoundaryChain& chain = patch.mesh.chain;
  const IdArray<VertexId, std::uint8_t> is_used = part.used_vertices();
  std::size_t vertices = whole.mesh.points.size(), facets = whole.mesh.faces.size();
  const auto vertex = ids_in_whole(patch.vertices, part.points.size(), vertices,
                                   [&](VertexId v) { return is_used[v] != 0; });
  auto facet = ids_in_whole(patch.facets, part.faces.size(), facets,
                            [&](FaceId f) { return !is_dead(part.faces[f]); });
  grow(whole.mesh.points, vertices);
  grow(whole.mesh.faces, facets);
  grow(whole.duals, facets);
  // New vertices and facets come after old ones, so they overwrite those whose ids they have. What
  // is outside the free box stays as it is, with its chain: its edges are those of frozen facets.
  for (VertexId v = patch.first_held; v < vertex.size(); ++v) {
    const VertexId in_whole = vertex[v];
    if (in_whole == kNoId) continue;
    whole.mesh.points[in_whole] = part.points[v];
    if (chain.is_boundary(v)) {
      whole.chain.set(in_whole, vertex[chain.previous(v)], vertex[chain.next(v)], chain.place(v));
    } else if (whole.chain.is_boundary(in_whole)) {
      whole.chain.set(in_whole, kNoId, kNoId, {});
    }
  }
  for (FaceId f = patch.free_box.first_free; f < facet.size(); ++f) {
    if (facet[f] == kNoId) continue;
    Face& face = whole.mesh.faces[facet[f]] = part.faces[f];
    whole.duals[facet[f]] = patch.mesh.duals[f];
    if (is_dead(face)) continue;
    for (VertexId& v : face.v) v = vertex[v];
    for (FaceId& g : face.n) g = g == kNoId ? g : facet[g];
  }
  // A frozen facet may have neighbors outside the patch, and begin with another vertex there.
  for (FaceId f = 0; f < patch.free_box.first_free; ++f) {
    const Face& own = part.faces[f];
    Face& face = whole.mesh.faces[facet[f]];
    const int first = corner_index(face, vertex[own.v[0]]);
    for (int i = 0; i < 3; ++i) {
      if (own.n[i] != kNoId) face.n[(first + i) % 3] = facet[own.n[i]];
    }
  }
  return facet;
}

}  // namespace deliso
