// SPDX-License-Identifier: MIT
#include "coarsen/embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/triangle.h"
#include "coarsen/facet_cells.h"
#include "coarsen/fans.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"
#include "surface/ring.h"

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
        cells_(s.mesh),
        normals_(s.mesh.faces.size()) {
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      const Triangle& t = mesh_.faces[f].v;
      if (!is_dead(mesh_.faces[f])) {
        normals_[f] = area_normal(point(t[0]), point(t[1]), point(t[2]));
      }
    }
  }

  EmbeddingFaults find() {
    find_crossings();
    find_reversed();
    find_passed();
    return std::move(faults_);
  }

 private:
  const Vec3& point(VertexId v) const { return mesh_.points[v]; }

  bool has_area(FaceId f) const {
    const Triangle& t = mesh_.faces[f].v;
    return length2(normals_[f]) > 0 && !collinear(point(t[0]), point(t[1]), point(t[2]));
  }

  void find_crossings() {
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (!is_dead(mesh_.faces[f]) && changed_[f.number()] != 0 && !has_area(f)) {
        faults_.facets.push_back(f);
      }
    }
    const IdArray<VertexId, std::uint8_t> is_fan = stars_that_are_fans(mesh_, normals_);
    cells_.for_each_pair([&](FaceId f, FaceId g) {
      if ((changed_[f.number()] | changed_[g.number()]) == 0) return;
      const Triangle &s = mesh_.faces[f].v, &t = mesh_.faces[g].v;
      for (const VertexId q : s) {
        if (is_fan[q] != 0 && has_corner(t, q)) return;
      }
      if (is_separated(mesh_.points, s, normals_[f], t) ||
          is_separated(mesh_.points, t, normals_[g], s) || !has_area(f) || !has_area(g)) {
        return;
      }
      if (triangles_intersect(mesh_.points, s, t)) {
        faults_.facets.insert(faults_.facets.end(), {f, g});
      }
    });
  }

  void find_reversed() {
    const std::vector<double> bounded = components_.volumes(mesh_);
    for (std::uint32_t c = 0; c < bounded.size(); ++c) {
      if (components_.origin[c] && !(bounded[c] * components_.bounded[c] > 0)) {
        faults_.components.push_back(c);
      }
    }
  }

  // The first facet that the line from p along the axis meets, in the direction of `sign`.
  struct Meeting {
    FaceId facet = kNoId;
    double at;
  };
  Meeting first_met(FaceId from, const Vec3& p, int axis, double sign) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 end = p;
    end[axis] = sign > 0 ? std::min(box_.hi[axis], free_box_.hi[axis])
                         : std::max(box_.lo[axis], free_box_.lo[axis]);
    Meeting met{kNoId, sign * (end[axis] - p[axis])};
    cells_.for_each_at(p, end, [&](FaceId f) {
      if (f == from) return;
      // p seen along the axis: on the inner side of every edge.
      const Triangle& t = mesh_.faces[f].v;
      const double facing = normals_[f][axis];
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = std::min(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const VertexId b = std::max(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const double turn = (point(b)[u] - point(a)[u]) * (p[v] - point(a)[v]) -
                            (point(b)[v] - point(a)[v]) * (p[u] - point(a)[u]);
        const bool is_left = a == t[kNextCorner[i]] ? turn > 0 : turn <= 0;
        if (is_left != (facing > 0)) return;
      }
      const double at = sign * dot(normals_[f], point(t[0]) - p) / facing;
      if (at > 0 && at < met.at) met = {f, at};
    });
    return met;
  }

  void find_passed() {
    constexpr double kGrazing = 0.1;  // a line in the facet's plane, nearly
    std::vector<FaceId> largest(components_.count(), kNoId);
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (is_dead(mesh_.faces[f])) continue;
      FaceId& known = largest[components_.of[mesh_.faces[f].v[0]]];
      if (known == kNoId || length2(normals_[f]) > length2(normals_[known])) known = f;
    }
    for (std::uint32_t c = 0; c < largest.size(); ++c) {
      const FaceId f = largest[c];
      if (f == kNoId || largest.size() == 1) continue;
      const Triangle& t = mesh_.faces[f].v;
      const Vec3 p = (point(t[0]) + point(t[1]) + point(t[2])) / 3, &n = normals_[f];
      if (!free_box_.holds(p)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        if (n[axis] * n[axis] < kGrazing * kGrazing * length2(n)) continue;
        for (const double sign : {1.0, -1.0}) {
          const Meeting met = first_met(f, p, axis, sign);
          // Facets that follow each other on a line face in turn.
          if (met.facet == kNoId || normals_[met.facet][axis] * n[axis] < 0) continue;
          faults_.facets.push_back(met.facet);
          faults_.components.push_back(c);
        }
      }
    }
  }

  const TriMesh& mesh_;
  const MeshComponents& components_;
  const std::span<const std::uint8_t> changed_;
  const FreeBox& free_box_;
  const Box3 box_;
  const FacetCells cells_;
  IdArray<FaceId, Vec3> normals_;
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
