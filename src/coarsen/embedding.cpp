// SPDX-License-Identifier: MIT
#include "coarsen/embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/triangle.h"
#include "coarsen/whole_mesh.h"

namespace deliso {
namespace {

class Embedding {
 public:
  Embedding(const SurfaceMesh& s, const MeshComponents& components,
            std::span<const std::uint8_t> changed, const FreeBox& free_box, const Box3& box)
      : mesh_(s.mesh),
        components_(components),
        changed_(changed),
        free_box_(free_box),
        box_(box),
        whole_(s.mesh) {}

  EmbeddingFaults find() {
    find_crossings();
    find_reversed();
    find_passed();
    return std::move(faults_);
  }

 private:
  void find_crossings() {
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (!is_dead(mesh_.faces[f]) && changed_[f.number()] != 0 && !whole_.has_area(f)) {
        faults_.facets.push_back(f);
      }
    }
    whole_.for_each_crossing(
        [&](FaceId f, FaceId g) { return (changed_[f.number()] | changed_[g.number()]) != 0; },
        [&](FaceId f, FaceId g) {
          faults_.facets.insert(faults_.facets.end(), {f, g});
        });
  }

  void find_reversed() {
    const std::vector<double> bounded = components_.volumes(mesh_);
    for (std::uint32_t c = 0; c < bounded.size(); ++c) {
      if (components_.origin[c] && !components_.is_left_out[c] &&
          !(bounded[c] * components_.bounded[c] > 0)) {
        faults_.components.push_back(c);
      }
    }
  }

  void find_passed() {
    std::vector<FaceId> largest(components_.count(), kNoId);
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (is_dead(mesh_.faces[f])) continue;
      FaceId& known = largest[components_.of[mesh_.faces[f].v[0]]];
      if (known == kNoId || length2(whole_.normal(f)) > length2(whole_.normal(known))) known = f;
    }
    for (std::uint32_t c = 0; c < largest.size(); ++c) {
      const FaceId f = largest[c];
      if (f == kNoId || largest.size() == 1 || components_.is_left_out[c]) continue;
      const Vec3 p = whole_.middle(f);
      if (!free_box_.holds(p)) continue;
      whole_.for_each_way_from(f, [&](int axis, double sign) {
        const double end = sign > 0 ? std::min(box_.hi[axis], free_box_.hi[axis])
                                    : std::max(box_.lo[axis], free_box_.lo[axis]);
        const FaceId met = whole_.first_met(f, p, axis, end);
        // Facets that follow each other on a line face in turn.
        if (met == kNoId || whole_.normal(met)[axis] * whole_.normal(f)[axis] < 0) return;
        faults_.facets.push_back(met);
        faults_.components.push_back(c);
      });
    }
  }

  const TriMesh& mesh_;
  const MeshComponents& components_;
  const std::span<const std::uint8_t> changed_;
  const FreeBox& free_box_;
  const Box3 box_;
  const WholeMesh whole_;
  EmbeddingFaults faults_;
};

}  // namespace

MeshComponents::MeshComponents(const TriMesh& mesh, const BoundaryChain& chain, FaceId first_free,
                               const Box3& box) {
  DisjointSets joined(mesh.points.size());
  for (const Face& face : mesh.faces) {
    joined.unite(face.v[0], face.v[1]);
    joined.unite(face.v[0], face.v[2]);
  }
  of = joined.take_numbers();
  const std::size_t count = of.empty() ? 0 : 1 + *std::ranges::max_element(of);
  size.resize(count);
  is_frozen.resize(count);
  is_left_out.resize(count);
  origin.resize(count);
  std::vector<unsigned> met(count);  // faces of the box
  for (VertexId v = 0; v < of.size(); ++v) {
    ++size[of[v]];
    if (chain.is_boundary(v)) met[of[v]] |= box_faces_at(mesh.points[v], box);
  }
  // A near point, for accuracy.
  for (const Face& face : mesh.faces) origin[of[face.v[0]]] = mesh.points[face.v[0]];
  for (FaceId f = 0; f < first_free; ++f) is_frozen[of[mesh.faces[f].v[0]]] = 1;
  for (std::size_t c = 0; c < count; ++c) {
    if (!origin[c]) continue;
    origin[c] = is_frozen[c] ? std::nullopt : moved_into_faces(*origin[c], met[c], box);
  }
  bounded = volumes(mesh);
}

std::vector<double> MeshComponents::volumes(const TriMesh& mesh) const {
  std::vector<double> volumes(count(), 0);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    const auto& [a, b, c] = face.v;
    const std::uint32_t n = of[a];
    if (!origin[n]) continue;
    volumes[n] += sixfold_volume(*origin[n], mesh.points[a], mesh.points[b], mesh.points[c]);
  }
  return volumes;
}

EmbeddingFaults embedding_faults(const SurfaceMesh& s, const MeshComponents& components,
                                 std::span<const std::uint8_t> changed, const FreeBox& free_box,
                                 const Box3& box) {
  return Embedding(s, components, changed, free_box, box).find();
}

}  // namespace deliso
