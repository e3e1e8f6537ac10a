// SPDX-License-Identifier: MIT
#include "more/bodies/sheet_faults.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/disjoint_sets.h"
#include "coarsen/whole_mesh.h"
#include "embedding/pages.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

class Faults {
 public:
  Faults(const Sheets& sheets, const CutSheets& cut, const Box3& box)
      : sheets_(sheets), box_(box), mesh_(with_own_vertices(sheets, cut)), whole_(mesh_) {}

  std::vector<FaceId> find() {
    find_crossings();
    find_wrong_order();
    find_passed();
    return std::move(faults_);
  }

 private:
  static TriMesh with_own_vertices(const Sheets& sheets, const CutSheets& cut) {
    TriMesh mesh;
    mesh.points = sheets.points;
    mesh.faces = cut.mesh.faces;
    for (std::size_t f = 0; f < sheets.facets.size(); ++f) {
      mesh.faces[FaceId(f)].v = sheets.facets[f].v;
    }
    return mesh;
  }
  const Vec3& point(VertexId v) const { return mesh_.points[v]; }
  bool is_free(FaceId f) const { return f < sheets_.free_facets; }

  void find_crossings() {
    for (FaceId f = 0; f < sheets_.free_facets; ++f) {
      if (!whole_.has_area(f)) faults_.push_back(f);
    }
    whole_.for_each_crossing([&](FaceId f, FaceId g) { return is_free(f) || is_free(g); },
                             [&](FaceId f, FaceId g) {
                               faults_.insert(faults_.end(), {f, g});
                             });
  }

  // Three sheets at an edge, each with a body on its left side and on its right side as they are
  // seen along the edge: one with body b on its left is followed by that with b on its right.
  void find_wrong_order() {
    std::vector<Triangle> triangles;
    for (const Face& face : mesh_.faces) triangles.push_back(face.v);
    const std::vector<EdgeUse> uses = edge_uses(mesh_.points.size(), triangles);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() > 3) {  // unreachable: by our own sheets
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

  void find_passed() {
    DisjointSets joined(mesh_.points.size());
    for (const Face& face : mesh_.faces) {
      joined.unite(face.v[0], face.v[1]);
      joined.unite(face.v[0], face.v[2]);
    }
    std::vector<FaceId> largest(mesh_.points.size(), kNoId);  // by the component's first vertex
    for (FaceId f = 0; f < sheets_.free_facets; ++f) {
      FaceId& known = largest[joined.find(mesh_.faces[f].v[0])];
      if (known == kNoId || length2(whole_.normal(f)) > length2(whole_.normal(known))) known = f;
    }
    for (const FaceId f : largest) {
      if (f == kNoId) continue;
      whole_.for_each_way_from(f, [&](int axis, double sign) {
        const double end = sign > 0 ? box_.hi[axis] : box_.lo[axis];
        const FaceId g = whole_.first_met(f, whole_.middle(f), axis, end);
        if (g == kNoId) return;
        const bool leaves_front = sign * whole_.normal(f)[axis] > 0;
        const bool meets_front = sign * whole_.normal(g)[axis] < 0;
        const BodyId from = sheets_.facets[f.number()].bodies[leaves_front ? 0 : 1];
        const BodyId to = sheets_.facets[g.number()].bodies[meets_front ? 0 : 1];
        if (from != to) faults_.insert(faults_.end(), {f, g});
      });
    }
  }

  const Sheets& sheets_;
  const Box3 box_;
  const TriMesh mesh_;  // with the vertices of the sheets, and links within them
  const WholeMesh whole_;
  std::vector<FaceId> faults_;
};

}  // namespace

std::vector<FaceId> sheet_faults(const Sheets& sheets, const CutSheets& cut, const Box3& box) {
  return Faults(sheets, cut, box).find();
}

}  // namespace deliso
