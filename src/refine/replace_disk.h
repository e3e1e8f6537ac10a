// SPDX-License-Identifier: MIT
// The one operation of Stage 2: a disk of facets out, another disk over the same rim in. Insertion,
// flip, triangulating a patch anew, collapse and move are five ways to propose one; at the mesh's
// boundary the rim may give way, from boundary vertex to boundary vertex.
//
// What Stage 1 hands over no replacement can take away, because each passes these gates, from cheap
// to dear:
//   G0  all of it is in the part of the mesh that is being refined (refine/parts.h);
//   G1  both are disks, and nothing of the new one is in the mesh already (the link condition): the
//       mesh stays a manifold, homeomorphic to what it was;
//   G2  no edge turns more sharply than asked for, or than one did before, and no component turns
//       inside out;
//   G3  every new facet above r_min finds its surface point; smaller ones may do without where they
//       face Sigma's outside; no more facets fail this than did before;
//   G4  what the proposer wants to fall, falls: so there is an end to it;
//   G5  no new facet crosses another, new or near, by exact predicates: the mesh stays embedded.
//       (This and the last of G2 are not asked with Parameters::as_published.)
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "refine/change_trace.h"
#include "refine/parts.h"
#include "refine/patch.h"
#include "surface/box_grid.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"
#include "surface/surface_point.h"

namespace deliso {

// The cosine between the normals at an edge that a rearrangement of facets may leave, unless one
// was sharper before. Flakes of Sigma thinner than a voxel have edges nearly as sharp.
inline constexpr double kSharpest = -0.97;

class DiskReplacer {
 public:
  // Keeps references, but for `part`.
  DiskReplacer(SurfaceMesh& surface_mesh, const Isosurface& surface, const Parameters& parameters,
               Report& report, const Part& part = {});

  // Fills change.was; whether change.out is a disk. Comes before replace().
  bool mark_old(Change& change);

  // Does it, or says which gate it did not pass and leaves everything as it was. accept(): G4,
  // asked when the duals are known and the vertex is in its place. The boundary chain is the
  // caller's.
  template <class Accept>
  std::optional<Refusal> replace(Change& change, Accept&& accept) {
    if (leaves_part(change)) return refuse_beyond();
    put_in_place(change);
    std::optional<Refusal> refusal = look_at(change);
    if (!refusal && !accept()) refusal = Refusal::no_gain;
    if (!refusal && crosses(change)) refusal = Refusal::crossing;
    refusal ? take_back(change) : commit(change);
    if (parameters_.trace) trace_replacement(*parameters_.trace, change, !refusal);
    return refusal;
  }
  // Counts what came of a try, and gives it back.
  std::optional<Refusal> count(Rung rung, const Change& change, std::optional<Refusal> refusal) {
    if (parameters_.trace) trace_try(*parameters_.trace, rung, change, refusal, report_);
    return report_[rung].count(refusal);
  }

  // Whether any vertex of the mesh but the corners of v is in the ball.
  bool holds_vertex(const Triangle& v, const Dual& ball) const;
  // Whether f has a surface ball, without vertices of the mesh.
  bool is_delaunay(FaceId f) const {
    return s_.duals[f].on_surface && !holds_vertex(mesh_.faces[f].v, s_.duals[f]);
  }
  // Facet f stays as it is: it is of no part, or of another.
  bool is_fixed(FaceId f) const { return f < part_.first; }
  // What would have to change such a facet is refused, and counted.
  Refusal refuse_beyond() {
    ++refused_beyond_;
    return Refusal::beyond_part;
  }
  // How many changes have been refused for the sake of other parts.
  std::size_t refused_beyond() const { return refused_beyond_; }
  const BoxGrid& facets() const { return facets_; }
  SurfacePointFinder& finder() { return finder_; }
  SearchCounters& searches() { return report_.searches_refine; }

 private:
  bool leaves_part(const Change& change) const;  // G0
  void put_in_place(const Change& change);
  void take_back(const Change& change);
  void commit(Change& change);
  void relist(VertexId v);  // in vertices_, where it is now

  // refine/gates.cpp
  std::optional<Refusal> look_at(Change& change);  // G1 to G3
  bool keeps_manifold(Change& change);
  bool is_joined_outside(VertexId a, VertexId b, const Change& change);
  bool turns(const Change& change);
  bool turns_inside_out(const Change& change);
  bool find_duals(Change& change);
  bool faces_out(const Triangle& v, const Vec3& normal) const;
  bool crosses(const Change& change);
  bool is_fan(const Change& change) const;
  void raise_walls(const Change& change);
  std::uint32_t behind(VertexId v);
  bool meet(const Change& change, std::size_t f, const Triangle& t) const;
  bool is_out(FaceId f) const { return marks_[f] == stamp_; }
  const Vec3& point(VertexId v) const { return mesh_.points[v]; }

  SurfaceMesh& s_;
  TriMesh& mesh_;
  const Isosurface& surface_;
  const Parameters& parameters_;
  Report& report_;
  const Part part_;
  std::size_t refused_beyond_ = 0;
  SurfacePointFinder finder_;
  BoxGrid facets_, vertices_;
  std::vector<FaceId> free_;  // dead facets

  // Of the change at hand.
  std::vector<std::uint32_t> marks_;  // per facet, stamp_ when it is to go
  std::uint32_t stamp_ = 0;
  Vec3 moved_from_;
  std::vector<FaceId> beyond_;       // per rim edge of the new disk; kNoId on the boundary
  std::vector<std::uint8_t> kept_;   // and whether it was the old one's too
  std::vector<std::uint32_t> seen_;  // per facet, seen_stamp_ when it is in rest_
  std::uint32_t seen_stamp_ = 0;
  std::vector<FaceId> rest_;  // of a small component, but for what is to go
  std::vector<Vec3> normals_;
  std::vector<BoxGrid::Box> boxes_;
  // Per new facet and side, the plane through it that stands upright on the facet.
  struct Side {
    VertexId from, to;
    Vec3 origin, outwards;
    double margin;
  };
  Side upright(const Triangle& t, const Vec3& normal, int i) const;
  bool is_off(const Side& side, VertexId v, double sign) const;
  bool is_beyond(const Side& side, const Triangle& t) const;
  bool parts(const Side& side, VertexId inside, const Triangle& other) const;
  std::vector<Side> walls_;
  static constexpr std::size_t kMostWalls = 32;
  struct Behind {
    std::uint32_t stamp = 0, walls = 0;
  };
  std::vector<Behind> behind_;  // per vertex, of the walls when stamp is wall_stamp_
  std::uint32_t wall_stamp_ = 0;
  std::vector<FaceId> star_;
};

}  // namespace deliso
