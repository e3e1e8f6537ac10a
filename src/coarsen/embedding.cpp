// SPDX-License-Identifier: MIT
#include "coarsen/embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/triangle.h"
#include "delaunay/predicates.h"
#include "embedding/box_grid.h"
#include "embedding/triangle_pair.h"
#include "surface/ring.h"

namespace deliso {
namespace {

class Embedding {
 public:
  Embedding(const SurfaceMesh& s, const MeshComponents& components,
            std::span<const std::uint8_t> changed, const FreeBox& free_box, const Box3& box)
      : mesh_(s.mesh),
        chain_(s.chain),
        components_(components),
        changed_(changed),
        free_box_(free_box),
        box_(box),
        grid_(box_of_all(s.mesh, box), cell_of(s.mesh)) {
    grid_.expect(mesh_.faces.size());
    normals_.resize(mesh_.faces.size());
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      const Triangle& t = mesh_.faces[f].v;
      if (!is_dead(mesh_.faces[f])) {
        normals_[f] = area_normal(point(t[0]), point(t[1]), point(t[2]));
      }
    }
    find_fans();
  }

  EmbeddingFaults find() {
    find_crossings();
    find_reversed();
    find_passed();
    return std::move(faults_);
  }

 private:
  // Frozen facets may reach out of the box.
  static Box3 box_of_all(const TriMesh& mesh, Box3 box) {
    for (const Vec3& p : mesh.points) box = united(box, {p, p});
    return box;
  }
  static double cell_of(const TriMesh& mesh) {
    std::vector<Triangle> triangles;
    for (const Face& face : mesh.faces) {
      if (!is_dead(face)) triangles.push_back(face.v);
    }
    return fitting_cell(mesh.points, triangles);
  }
  const Vec3& point(VertexId v) const { return mesh_.points[v]; }

  // Two facets with a common vertex whose star is a fan do not cross.
  void find_fans() {
    is_fan_.resize(mesh_.points.size(), 0);
    IdArray<VertexId, std::uint8_t> is_known(mesh_.points.size(), 0);
    Ring ring;
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (is_dead(mesh_.faces[f]) || changed_[f.number()] == 0) continue;
      for (const VertexId v : mesh_.faces[f].v) {
        if (std::exchange(is_known[v], 1) != 0) continue;
        if (!ring.walk(mesh_, f, v, chain_.is_boundary(v))) continue;
        ring.project();
        is_fan_[v] = ring.is_fan();
      }
    }
  }

  // True if a plane through a side of f, perpendicular to f, has g on the other side, with a margin
  // above rounding.
  bool is_apart(FaceId f, FaceId g) const {
    const Triangle &s = mesh_.faces[f].v, &t = mesh_.faces[g].v;
    const auto l1 = [](const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = s[kNextCorner[i]], to = s[kPreviousCorner[i]];
      const Vec3 out = cross(point(to) - point(from), normals_[f]);
      constexpr double kMargin = 1e-10;
      const double margin = kMargin * l1(out);
      if (std::ranges::all_of(t, [&](VertexId q) {
            const Vec3 w = point(q) - point(from);
            return q == from || q == to || dot(out, w) > margin * l1(w);
          })) {
        return true;
      }
    }
    return false;
  }

  bool cross_each_other(FaceId f, FaceId g) const {
    const Triangle &s = mesh_.faces[f].v, &t = mesh_.faces[g].v;
    for (const VertexId q : s) {
      if (is_fan_[q] != 0 && has_corner(t, q)) return false;
    }
    return !is_apart(f, g) && !is_apart(g, f) && triangles_intersect(mesh_.points, s, t);
  }

  void find_crossings() {
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (!is_dead(mesh_.faces[f]) && changed_[f.number()] == 0) {
        grid_.add(f, grid_.box_of(mesh_.points, mesh_.faces[f].v));
      }
    }
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (is_dead(mesh_.faces[f]) || changed_[f.number()] == 0) continue;
      const Triangle& t = mesh_.faces[f].v;
      const BoxGrid::Box box = grid_.box_of(mesh_.points, t);
      if (!(length2(normals_[f]) > 0) || collinear(point(t[0]), point(t[1]), point(t[2]))) {
        faults_.facets.push_back(f);
      } else {
        grid_.any(box, [&](FaceId g, const BoxGrid::Box&) {
          if (cross_each_other(f, g)) faults_.facets.insert(faults_.facets.end(), {f, g});
          return false;
        });
      }
      grid_.add(f, box);
    }
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
    const std::array<Vec3, 2> ends{p, end};
    Meeting met{kNoId, sign * (end[axis] - p[axis])};
    grid_.any(grid_.box_of(ends), [&](FaceId f, const BoxGrid::Box&) {
      if (f == from) return false;
      // p seen along the axis: on the inner side of every edge.
      const Triangle& t = mesh_.faces[f].v;
      const double facing = normals_[f][axis];
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = std::min(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const VertexId b = std::max(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const double turn = (point(b)[u] - point(a)[u]) * (p[v] - point(a)[v]) -
                            (point(b)[v] - point(a)[v]) * (p[u] - point(a)[u]);
        const bool is_left = a == t[kNextCorner[i]] ? turn > 0 : turn <= 0;
        if (is_left != (facing > 0)) return false;
      }
      const double at = sign * dot(normals_[f], point(t[0]) - p) / facing;
      if (at > 0 && at < met.at) met = {f, at};
      return false;
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
  const BoundaryChain& chain_;
  const MeshComponents& components_;
  const std::span<const std::uint8_t> changed_;
  const FreeBox& free_box_;
  const Box3 box_;
  BoxGrid grid_;
  IdArray<FaceId, Vec3> normals_;
  IdArray<VertexId, std::uint8_t> is_fan_;
  EmbeddingFaults faults_;
};

}  // namespace

MeshComponents::MeshComponents(const TriMesh& mesh, const BoundaryChain& chain, FaceId first_free,
                               const Box3& box)
    : of(mesh.points.size(), kNoId) {
  DisjointSets joined(mesh.points.size());
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    joined.unite(face.v[0], face.v[1]);
    joined.unite(face.v[0], face.v[2]);
  }
  std::vector<std::uint32_t> number(mesh.points.size(), kNoId);
  std::vector<unsigned> met;  // per component: faces of the box
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    for (const VertexId v : mesh.faces[f].v) {
      std::uint32_t& c = number[joined.find(v)];
      if (c == kNoId) {
        c = static_cast<std::uint32_t>(origin.size());
        origin.emplace_back(mesh.points[v]);  // a near point, for accuracy
        is_frozen.push_back(0);
        met.push_back(0);
      }
      if (of[v] == kNoId && chain.is_boundary(v)) met[c] |= box_faces_at(mesh.points[v], box);
      of[v] = c;
      is_frozen[c] |= f < first_free;
    }
  }
  for (std::size_t c = 0; c < origin.size(); ++c) {
    origin[c] = is_frozen[c] ? std::nullopt : moved_into_faces(*origin[c], met[c], box);
  }
  bounded = volumes(mesh);
}

std::vector<double> MeshComponents::volumes(const TriMesh& mesh) const {
  std::vector<double> volumes(count(), 0);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    const std::uint32_t c = of[face.v[0]];
    if (!origin[c]) continue;
    const Vec3 &o = *origin[c], a = mesh.points[face.v[0]] - o;
    volumes[c] += dot(a, cross(mesh.points[face.v[1]] - o, mesh.points[face.v[2]] - o));
  }
  return volumes;
}

EmbeddingFaults embedding_faults(const SurfaceMesh& s, const MeshComponents& components,
                                 std::span<const std::uint8_t> changed, const FreeBox& free_box,
                                 const Box3& box) {
  return Embedding(s, components, changed, free_box, box).find();
}

}  // namespace deliso
