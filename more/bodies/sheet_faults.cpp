// SPDX-License-Identifier: MIT
#include "more/bodies/sheet_faults.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/disjoint_sets.h"
#include "base/triangle.h"
#include "coarsen/facet_cells.h"
#include "coarsen/fans.h"
#include "delaunay/predicates.h"
#include "embedding/pages.h"
#include "embedding/triangle_pair.h"
#include "mesh/incidence.h"
#include "surface/ring.h"

namespace deliso {
namespace {

class Faults {
 public:
  Faults(const Sheets& sheets, const CutSheets& cut, const Box3& box) : sheets_(sheets), box_(box) {
    mesh_.points = sheets.points;
    mesh_.faces = cut.mesh.faces;
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      const Triangle& t = mesh_.faces[f].v = sheets.facets[f].v;
      normals_.push_back(area_normal(point(t[0]), point(t[1]), point(t[2])));
    }
  }

  std::vector<FaceId> find() {
    const FacetCells cells(mesh_);
    find_crossings(cells);
    find_wrong_order();
    find_passed(cells);
    return std::move(faults_);
  }

 private:
  const Vec3& point(VertexId v) const { return mesh_.points[v]; }
  bool is_free(FaceId f) const { return f < sheets_.free_facets; }
  bool has_area(FaceId f) const {
    const Triangle& t = mesh_.faces[f].v;
    return length2(normals_[f]) > 0 && !collinear(point(t[0]), point(t[1]), point(t[2]));
  }

  void find_crossings(const FacetCells& cells) {
    for (FaceId f = 0; f < sheets_.free_facets; ++f) {
      if (!has_area(f)) faults_.push_back(f);
    }
    const IdArray<VertexId, std::uint8_t> is_fan = stars_that_are_fans(mesh_, normals_);
    cells.for_each_pair([&](FaceId f, FaceId g) {
      if (!is_free(f) && !is_free(g)) return;
      const Triangle &s = mesh_.faces[f].v, &t = mesh_.faces[g].v;
      for (const VertexId q : s) {
        if (is_fan[q] != 0 && has_corner(t, q)) return;
      }
      if (is_separated(mesh_.points, s, normals_[f], t) ||
          is_separated(mesh_.points, t, normals_[g], s) || !has_area(f) || !has_area(g)) {
        return;
      }
      if (triangles_intersect(mesh_.points, s, t)) faults_.insert(faults_.end(), {f, g});
    });
  }

  // Three sheets at an edge, each with a body on its left side and on its right side as they are
  // seen along the edge: one with body b on its left is followed by that with b on its right.
  void find_wrong_order() {
    std::vector<Triangle> triangles;
    for (const Face& face : mesh_.faces) triangles.push_back(face.v);
    const std::vector<EdgeUse> uses = edge_uses(mesh_.points.size(), triangles);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() > 3) {
        for (const EdgeUse& use : edge) faults_.push_back(use.triangle);
      }
      if (edge.size() != 3) return true;
      struct Page {
        VertexId apex;
        BodyId left, right;
      };
      std::array<Page, 3> pages;
      for (std::size_t n = 0; n < 3; ++n) {
        const EdgeUse& use = edge[n];
        // Seen from the end of the edge, a facet that runs along it has its front on the left.
        const auto [front, behind] = sheets_.facets[use.triangle.number()].bodies;
        const VertexId apex = triangles[use.triangle.number()][use.side];
        pages[n] = use.forward ? Page{apex, front, behind} : Page{apex, behind, front};
      }
      if (pages[0].left != pages[1].right) std::swap(pages[1], pages[2]);
      for (std::size_t n = 0; n < 3; ++n) {
        if (pages[n].left != pages[(n + 1) % 3].right) return true;  // not all are there
      }
      if (!are_in_order(point(edge[0].lo), point(edge[0].hi), point(pages[0].apex),
                        point(pages[1].apex), point(pages[2].apex))) {
        for (const EdgeUse& use : edge) faults_.push_back(use.triangle);
      }
      return true;
    });
  }

  // Returns the first facet that the line from p along the axis meets, in the direction of `sign`.
  FaceId first_met(const FacetCells& cells, FaceId from, const Vec3& p, int axis,
                   double sign) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 end = p;
    end[axis] = sign > 0 ? box_.hi[axis] : box_.lo[axis];
    FaceId met = kNoId;
    double nearest = sign * (end[axis] - p[axis]);
    cells.for_each_at(p, end, [&](FaceId f) {
      if (f == from) return;
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
      if (at > 0 && at < nearest) nearest = at, met = f;
    });
    return met;
  }

  void find_passed(const FacetCells& cells) {
    constexpr double kGrazing = 0.1;  // a line in the facet's plane, nearly
    DisjointSets joined(mesh_.points.size());
    for (const Face& face : mesh_.faces) {
      joined.unite(face.v[0], face.v[1]);
      joined.unite(face.v[0], face.v[2]);
    }
    std::vector<FaceId> largest(mesh_.points.size(), kNoId);  // by the component's first vertex
    for (FaceId f = 0; f < sheets_.free_facets; ++f) {
      FaceId& known = largest[joined.find(mesh_.faces[f].v[0])];
      if (known == kNoId || length2(normals_[f]) > length2(normals_[known])) known = f;
    }
    for (const FaceId f : largest) {
      if (f == kNoId) continue;
      const Triangle& t = mesh_.faces[f].v;
      const Vec3 p = (point(t[0]) + point(t[1]) + point(t[2])) / 3, &n = normals_[f];
      for (int axis = 0; axis < 3; ++axis) {
        if (n[axis] * n[axis] < kGrazing * kGrazing * length2(n)) continue;
        for (const double sign : {1.0, -1.0}) {
          const FaceId g = first_met(cells, f, p, axis, sign);
          if (g == kNoId) continue;
          const bool leaves_front = sign * n[axis] > 0, meets_front = sign * normals_[g][axis] < 0;
          const BodyId from = sheets_.facets[f.number()].bodies[leaves_front ? 0 : 1];
          const BodyId to = sheets_.facets[g.number()].bodies[meets_front ? 0 : 1];
          if (from != to) faults_.insert(faults_.end(), {f, g});
        }
      }
    }
  }

  const Sheets& sheets_;
  const Box3 box_;
  TriMesh mesh_;  // with the vertices of the sheets, and links within them
  IdArray<FaceId, Vec3> normals_;
  std::vector<FaceId> faults_;
};

}  // namespace

std::vector<FaceId> sheet_faults(const Sheets& sheets, const CutSheets& cut, const Box3& box) {
  return Faults(sheets, cut, box).find();
}

}  // namespace deliso
