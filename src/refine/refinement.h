// SPDX-License-Identifier: MIT
// The state of Stage 2 and its one operation: a disk of facets, the cavity, is replaced by another
// disk over the same boundary. Insertion, flip, collapse and move (refine/operations.h) are ways to
// propose one. At the mesh's boundary the cavity's boundary may change too, from one boundary
// vertex to another.
//
// Stage 1 hands over a manifold, homeomorphic to Sigma, embedded, with its vertices on Sigma. No
// replacement takes that away, because each passes these tests, from cheap to expensive:
//   G0  no frozen facet goes, and what comes stays in the region (refine/regions.h);
//   G1  both are disks, and no new facet or edge is in the mesh already (the link condition): the
//       mesh stays a manifold. It stays homeomorphic to what it was if the boundaries of the two
//       disks differ in at most one run of the mesh's boundary edges. That is the operation's to
//       keep (docs/proof.md);
//   G2  no edge is folded more sharply than asked for, or than one was before, and no small
//       component is reversed;
//   G3  new facets have surface points. Those below r_min that face Sigma's outside may lack one,
//       and of the others no more than lacked one before;
//   G4  the mesh stays near the place of a vertex that is removed: within twice the bound on the
//       distance. And the operation lowers the measure that it is to lower, so Stage 2 ends;
//   G5  no new facet crosses another, new or near, by exact predicates: the mesh stays embedded.
// With Parameters::as_published neither G5 nor the last part of G2 is asked.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "embedding/disk_crossing.h"
#include "mesh/disk.h"
#include "surface/observer.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"
#include "surface/surface_point.h"

namespace deliso {

// The edge of facet `face` opposite its corner `index`.
struct EdgeRef {
  FaceId face = kNoId;
  int index = 0;
};

// Facets before `first_free` are frozen (refine/regions.h). All others may be replaced, by facets
// within the box from `lo` to `hi`; `lo` belongs to it, `hi` does not.
struct Region {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  FaceId first_free = 0;
  Vec3 lo{-kFar, -kFar, -kFar}, hi{kFar, kFar, kFar};

  bool holds(const Vec3& p) const {
    return lo.x <= p.x && p.x < hi.x && lo.y <= p.y && p.y < hi.y && lo.z <= p.z && p.z < hi.z;
  }
  // True if the box holds all that is no further than `radius` from p.
  bool holds(const Vec3& p, double radius) const {
    const Vec3 r{radius, radius, radius};
    return holds(p - r) && holds(p + r);
  }
};

// The cosine between the normals at an edge that a rearrangement of facets may leave, unless one
// was sharper before. Flakes of Sigma thinner than a voxel have edges nearly as sharp.
inline constexpr double kSharpestFold = -0.97;

// What an operation proposes.
struct Change {
  std::vector<FaceId> cavity;  // the facets that go
  Disk was;                    // the same by their corners, linked by open_cavity()
  Disk in;                     // what takes their place; for a vertex that comes, set_cone()
  enum class Vertex : std::uint8_t { none, comes, moves } what = Vertex::none;
  VertexId vertex = kNoId;   // when it comes, the mesh's vertex count
  Vec3 place;                // where it comes or moves to
  double least_cosine = -1;  // G2: between the normals at an edge; -1: not asked
  // Set when the cavity lies flat in a face of the volume's box and is to be brought out of it,
  // however far from Sigma: G3 and G4 are not asked. A component that lies flat in that face bounds
  // nothing yet, so it may be oriented either way.
  bool topology_only = false;
  std::vector<Dual> duals;  // of `in`, by G3
  bool has_duals() const { return duals.size() == in.facets.size(); }
  std::vector<FaceId> created;  // of `in`, once it is done
};

class Refinement {
 public:
  // Copies `parameters` and `region`; keeps references to the rest.
  Refinement(SurfaceMesh& surface_mesh, const Isosurface& surface, const BoundaryCurves& curves,
             const Parameters& parameters, Report& report, const Region& region = {});

  SurfaceMesh& s;
  TriMesh& mesh;
  const Isosurface& surface;
  const BoundaryCurves& curves;
  Parameters parameters;  // the bound on the distance gives way to target_vertices
  Report& report;
  Observer* const observer;  // null unless it follows insertions
  const Region region;
  const std::size_t removable;  // vertices that may go: those that were there from the first
  SurfacePointFinder finder;
  Change change;                         // the last one proposed
  std::vector<std::uint8_t> move_tries;  // per vertex; grows when it is asked for

  // `change`, as an operation finds it: nothing is proposed.
  Change& begin_change(double least_cosine = -1);
  // Marks change.cavity and links change.was; refused if that is no disk.
  std::optional<Refusal> open_cavity(Change& change);
  // Makes `in` the cone from the new vertex, at `place`, to the boundary of the cavity, without the
  // edge of the mesh's boundary that the vertex splits, if it splits one. pre: open_cavity().
  void set_cone(Change& change, const Vec3& place, EdgeRef split = {}) const;
  // Does the change, or returns the test that it does not pass and leaves everything as it was.
  // accept() tells whether the operation still gains: the measure that it is to lower is lower, or
  // may still become so. It is asked when the vertex is in its place, first without duals (surface
  // points and balls) of the new facets, then again after each that is found. The caller updates
  // the boundary chain. pre: open_cavity().
  template <class Accept>
  std::optional<Refusal> replace(Change& c, Accept&& accept) {
    if (leaves_region(c)) return Refusal::frozen;
    put_in_place(c);
    c.duals.clear();
    std::optional<Refusal> refusal = test_shape(c);
    if (!refusal && !accept()) refusal = Refusal::no_gain;
    for (std::ptrdiff_t allowed = facets_without_point(c); !refusal && !c.has_duals();) {
      refusal = !find_dual(c, allowed) ? std::optional(Refusal::no_surface_point)
                : !accept()            ? std::optional(Refusal::no_gain)
                                       : std::nullopt;
    }
    if (!refusal && uncovers(c)) refusal = Refusal::uncovers;
    if (!refusal && crosses(c)) refusal = Refusal::crossing;
    refusal ? take_back(c) : commit(c);
    return refusal;
  }

  // Counts what came of an operation, tells the observer, and gives it back.
  std::optional<Refusal> done(Rung rung, std::optional<Refusal> refusal);
  std::span<const FaceId> created() const { return change.created; }

  // Of a facet with these corners; without a surface point h is as large as it can be.
  FacetShape shape(const Triangle& v, const Dual& dual) const;
  FacetShape shape(FaceId f) const { return shape(mesh.faces[f].v, s.duals[f]); }
  // Over 1: a criterion is not met.
  double violation(const Triangle& v, const Dual& dual) const {
    return deliso::violation(shape(v, dual), parameters.refinement);
  }
  // True if the facet has a surface ball, without vertices of the mesh.
  bool is_delaunay(const Triangle& v, const Dual& dual) const;
  bool is_delaunay(FaceId f) const { return is_delaunay(mesh.faces[f].v, s.duals[f]); }
  bool is_frozen(FaceId f) const { return f < region.first_free; }
  const BoxGrid& facets() const { return facets_; }
  const Vec3& point(VertexId v) const { return mesh.points[v]; }
  Vec3 normal(const Triangle& v) const {
    return area_normal(point(v[0]), point(v[1]), point(v[2]));
  }

 private:
  bool leaves_region(const Change& change) const;
  void put_in_place(const Change& change);
  void take_back(const Change& change);
  void commit(Change& change);
  void move_to(VertexId v, const Vec3& place);

  // refine/gates.cpp
  std::optional<Refusal> test_shape(Change& change);  // G1 and G2
  // G3 for the next facet of `in`. False if one more lacks its surface point than may.
  bool find_dual(Change& change, std::ptrdiff_t& allowed);
  // How many facets of `in` above r_min may lack one.
  std::ptrdiff_t facets_without_point(const Change& change) const;
  bool keeps_manifold(Change& change);
  bool is_joined_outside(VertexId a, VertexId b, const Change& change);
  double sharpest_edge(const Disk& disk, std::span<const Vec3> normals,
                       std::span<const FaceId> across) const;
  bool folds(const Change& change) const;
  bool reverses(const Change& change);
  bool uncovers(const Change& change) const;  // G4
  bool faces_out(const Triangle& v, const Vec3& normal) const;
  bool crosses(const Change& change);
  Vec3 point_before(const Change& c, VertexId v) const {
    return c.what == Change::Vertex::moves && v == c.vertex ? moved_from_ : point(v);
  }
  bool is_small(const Dual& dual) const {
    return dual.radius2 <= parameters.r_min * parameters.r_min;
  }

  bool is_out(FaceId f) const { return marks_[f] == stamp_; }

  BoxGrid facets_, vertices_;

  // Of the change at hand.
  std::vector<std::uint32_t> marks_;  // per facet, stamp_ when it is in the cavity
  std::uint32_t stamp_ = 0;
  Vec3 moved_from_;
  std::vector<FaceId> across_;  // per boundary edge of the new disk; kNoId on the mesh's
  std::vector<FaceId> rest_;    // of a small component, but for the cavity
  std::vector<Vec3> normals_;
  DiskCrossing crossing_;
  std::vector<FaceId> star_;
};

}  // namespace deliso
