// SPDX-License-Identifier: MIT
#include "more/bodies/refine_sheets.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "more/bodies/borders.h"
#include "refine/refine.h"

namespace deliso {
namespace {

class SheetRefiner {
 public:
  SheetRefiner(const Sheets& sheets, const SheetScope& scope, Report& report)
      : scope_(scope),
        report_(report),
        cut_(sheets),
        borders_(scope.partition, scope.parameters, scope.distance, sheets, cut_),
        points_(sheets.points),
        parts_(cut_.sheets.size()) {
    for (FaceId f = 0; f < sheets.facets.size(); ++f) {
      Part& part = parts_[cut_.sheet[f]];
      (f < sheets.free_facets ? part.free : part.fixed).push_back(sheets.facets[f.number()]);
      (f < sheets.free_facets ? part.free_ids : part.fixed_ids).push_back(f);
    }
    for (Part& part : parts_) part.box = box_of(part);
  }

  Sheets run() {
    for (std::uint32_t sheet = 0; sheet < parts_.size(); ++sheet) {
      if (scope_.partition.is_beyond(cut_.sheets[sheet][0])) {
        for (SheetFacet& f : parts_[sheet].free) f.is_done = true;
      } else if (!std::ranges::all_of(parts_[sheet].free, &SheetFacet::is_done)) {
        refine(sheet);
      }
    }
    Sheets made{std::move(points_), {}, 0};
    for (const auto facets : {&Part::free, &Part::fixed}) {
      for (const Part& part : parts_) {
        made.facets.insert(made.facets.end(), (part.*facets).begin(), (part.*facets).end());
      }
      if (facets == &Part::free) made.free_facets = made.facets.size();
    }
    return made;
  }

 private:
  // A sheet: its facets that may change, and the others.
  struct Part {
    std::vector<SheetFacet> free, fixed;
    std::vector<FaceId> free_ids, fixed_ids;  // in the cut sheets, before it was refined
    Box3 box;
  };

  Box3 box_of(const Triangle& v) const {
    return deliso::box_of(points_[v[0]], points_[v[1]], points_[v[2]]);
  }
  Box3 box_of(const Part& part) const {
    Box3 box = box_of((part.free.empty() ? part.fixed[0] : part.free[0]).v);
    for (const SheetFacet& f : part.free) box = united(box, box_of(f.v));
    for (const SheetFacet& f : part.fixed) box = united(box, box_of(f.v));
    return box;
  }

  void refine(std::uint32_t sheet) {
    Part& own = parts_[sheet];
    SurfaceMesh s;
    const FaceId frozen = add_frozen(sheet, s.mesh);
    for (const SheetFacet& f : own.free) s.mesh.faces.push_back({f.v, {kNoId, kNoId, kNoId}});
    link(own, frozen, s.mesh);
    known_.resize(points_.size(), kNoId);
    std::vector<VertexId> vertices = number_vertices(s.mesh.faces, known_);
    for (const VertexId v : vertices) s.mesh.points.push_back(points_[v]);
    const std::vector<std::uint8_t> is_done = refine(sheet, s, frozen);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      points_[vertices[v]] = s.mesh.points[VertexId(v)];
    }
    for (std::size_t v = vertices.size(); v < s.mesh.points.size(); ++v) {
      vertices.emplace_back(points_.size());
      points_.push_back(s.mesh.points[VertexId(v)]);
    }
    own.free.clear();
    for (FaceId f = frozen; f < s.mesh.faces.size(); ++f) {
      if (is_dead(s.mesh.faces[f])) continue;
      SheetFacet facet{s.mesh.faces[f].v, cut_.sheets[sheet], is_done[f] != 0};
      for (VertexId& v : facet.v) v = vertices[v];
      own.free.push_back(facet);
    }
    own.box = box_of(own);
  }

  // Adds the facets of other sheets near this one, and those of its own that stay. Returns how
  // many.
  FaceId add_frozen(std::uint32_t sheet, TriMesh& mesh) const {
    const Box3 near = parts_[sheet].box.grown(2 * scope_.parameters.voxel);
    const auto add = [&](const Triangle& v) { mesh.faces.push_back({v, {kNoId, kNoId, kNoId}}); };
    for (const SheetFacet& f : parts_[sheet].fixed) add(f.v);
    for (std::uint32_t other = 0; other < parts_.size(); ++other) {
      const Part& part = parts_[other];
      if (other == sheet || !meet(near, part.box)) continue;
      for (const auto* facets : {&part.free, &part.fixed}) {
        for (const SheetFacet& f : *facets) {
          if (meet(near, box_of(f.v))) add(f.v);
        }
      }
    }
    return FaceId(mesh.faces.size());
  }

  // Links the facets of a sheet: its fixed ones come first, its free ones after the frozen.
  void link(const Part& own, FaceId frozen, TriMesh& mesh) {
    new_id_.resize(cut_.mesh.faces.size());
    for (std::size_t n = 0; n < own.fixed_ids.size(); ++n) new_id_[own.fixed_ids[n]] = FaceId(n);
    for (std::size_t n = 0; n < own.free_ids.size(); ++n) {
      new_id_[own.free_ids[n]] = FaceId(frozen + n);
    }
    for (const auto* ids : {&own.fixed_ids, &own.free_ids}) {
      for (const FaceId f : *ids) {
        for (std::size_t i = 0; i < 3; ++i) {
          const FaceId g = cut_.mesh.faces[f].n[i];
          if (g != kNoId) mesh.faces[new_id_[f]].n[i] = new_id_[g];
        }
      }
    }
  }

  // Returns per facet whether it is done.
  std::vector<std::uint8_t> refine(std::uint32_t sheet, SurfaceMesh& s, FaceId frozen) {
    Border& border = borders_[sheet];
    s.duals.resize(s.mesh.faces.size());
    for (FaceId f = frozen; f < s.mesh.faces.size(); ++f) {
      const Triangle& v = s.mesh.faces[f].v;
      s.duals[f] = border.finder.dual(s.mesh.points[v[0]], s.mesh.points[v[1]], s.mesh.points[v[2]],
                                      report_.searches_refine);
    }
    BoundaryLoops loops(1);
    add_chain(s, frozen, loops[0]);
    const BoundaryCurves curves(border.surface,
                                std::make_shared<const BoundaryLoops>(std::move(loops)));
    RefineScope part;
    part.free_box = {frozen, scope_.box.lo, scope_.box.hi};
    for (int axis = 0; axis < 3; ++axis) {
      double& lo = part.free_box.lo[axis];
      if ((scope_.inner_faces >> (2 * axis) & 1) != 0) lo = std::nextafter(lo, FreeBox::kFar);
    }
    part.is_done.assign(frozen, 1);
    for (const SheetFacet& f : parts_[sheet].free) part.is_done.push_back(f.is_done);
    return refine_part(s, {}, {border.surface, curves, scope_.parameters, report_},
                       std::move(part));
  }

  // The sheet's boundary as arcs that are fixed. A vertex at which the sheet ends twice has one
  // place.
  static void add_chain(SurfaceMesh& s, FaceId frozen, BoundaryLoop& loop) {
    IdArray<VertexId, VertexId> next(s.mesh.points.size(), kNoId), previous = next;
    for (FaceId f = frozen; f < s.mesh.faces.size(); ++f) {
      const Face& face = s.mesh.faces[f];
      for (std::size_t i = 0; i < 3; ++i) {
        if (face.n[i] != kNoId) continue;
        const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
        next[a] = b;
        previous[b] = a;
      }
    }
    for (VertexId v = 0; v < next.size(); ++v) {
      if (next[v] == kNoId && previous[v] == kNoId) continue;
      s.chain.set(v, previous[v] == kNoId ? next[v] : previous[v],
                  next[v] == kNoId ? previous[v] : next[v], {0, static_cast<double>(loop.size())});
      loop.push_back({s.mesh.points[v], {}, true, true});
    }
  }

  const SheetScope& scope_;
  Report& report_;
  CutSheets cut_;
  Borders borders_;
  std::vector<Vec3> points_;
  std::vector<Part> parts_;
  IdArray<FaceId, FaceId> new_id_;  // of a sheet's facets, in its mesh
  IdArray<VertexId, VertexId> known_;
};

}  // namespace

void refine_sheets(Sheets& sheets, const SheetScope& scope, Report& report) {
  sheets = SheetRefiner(sheets, scope, report).run();
}

}  // namespace deliso
