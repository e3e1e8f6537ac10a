// SPDX-License-Identifier: MIT
// The state of Stage 2 and its one change: another disk over the same boundary replaces a disk of
// facets, the cavity. Insertion, flip, collapse and move (refine/operations.h) and removal
// (refine/thin.h) propose such changes. On the mesh's boundary the boundary of the cavity may
// change too, between two boundary vertices.
//
// The mesh of Stage 1 is a manifold, homeomorphic to Sigma, embedded, with its vertices on Sigma.
// Every replacement keeps that, because it passes these tests, from cheap to expensive. Only moves
// of refine/separate.h and lifts off the box take vertices off Sigma.
//   G0  No frozen facet is removed, and a vertex comes or moves only to places in the free box.
//       That is a block without its inner faces (FreeBox::within). Where a part of a mesh is
//       refined (blocks/seams.h), it is the part's box, and facets outside are frozen.
//   G1  Both are disks, and no new facet or edge is in the mesh already (the link condition), or
//       would lie in a face between blocks. So the mesh stays a manifold. Its topology stays if the
//       boundaries of the two disks differ in at most one run of the mesh's boundary edges; the
//       operation must ensure that (docs/proof.md).
//   G2  No small component is reversed. No edge is folded more sharply than the proposal's limit,
//       or than one was before; insertions and boundary splits have no limit.
//   G3  New facets have surface points. Those below r_min that face Sigma's outside may lack one;
//       of the others, no more than before.
//   G4  A removed vertex is within twice the bound on the distance of the new facets. The operation
//       lowers its quantity, so Stage 2 ends.
//   G5  No new facet crosses another, by exact predicates. So the mesh stays embedded. None is a
//       needle without an area but for rounding, unless one was.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "embedding/box_grid.h"
#include "embedding/disk_crossing.h"
#include "mesh/disk.h"
#include "run/observer.h"
#include "run/parameters.h"
#include "run/report.h"
#include "surface/free_box.h"
#include "surface/surface_mesh.h"
#include "surface/surface_point.h"

namespace deliso {

// The edge of facet `face` opposite its corner `index`.
struct EdgeRef {
  FaceId face = kNoId;
  int index = 0;
};

// Least cosine between the normals at an edge after a change, unless one was less before. Pieces of
// Sigma thinner than a voxel have edges nearly as sharp.
inline constexpr double kSharpestFold = -0.97;
inline constexpr double kAnyFold = -1;

// An edge of the mesh's boundary that a new vertex splits, the vertex before it in the boundary
// chain, and the new one's place on the curve.
struct BoundarySplit {
  EdgeRef edge;
  VertexId before = kNoId;
  CurvePlace place;
};

// A proposed replacement. Refinement::propose() finds that the cavity is a disk; cone(), move(),
// merge() or facets() say what comes in its place.
struct Proposal {
  std::vector<FaceId> cavity;  // the facets to be removed
  Disk was;                    // the same by their corners
  Disk in;                     // the new disk; linked by G1
  enum class Vertex : std::uint8_t { none, comes, moves } what = Vertex::none;
  VertexId vertex = kNoId;             // moved or new; a new one is the mesh's vertex count
  Vec3 place;                          // of the new vertex, or to which the vertex moves
  std::optional<BoundarySplit> split;  // by the vertex that comes
  double least_cosine = kAnyFold;      // G2: between the normals at an edge
  // False: without G3 and G4. Of a cavity that lies in a face of the domain box, to be lifted, at
  // any distance from Sigma. A component in that face bounds no volume yet, so either orientation
  // is allowed.
  bool asks_surface = true;
  // `in` is linked, and so are the facets across, as a vertex only moves.
  bool is_linked = false;
  std::vector<Dual> duals;  // of `in`, by G3
  // `duals` were set before replace(), each with a surface point.
  bool knows_duals = false;
  bool has_duals() const { return duals.size() == in.facets.size(); }
  std::vector<FaceId> created;  // ids of `in` in the mesh, after the replacement

  // The cone from a new vertex at p to the boundary of the cavity. It has no facet on the edge that
  // the vertex splits, if any.
  void cone(const Vec3& p, const BoundarySplit* by = nullptr);
  // The same facets, with v at p.
  void move(VertexId v, const Vec3& p);
  // The facets without corner `to`, with `from` at `to`.
  void merge(VertexId from, VertexId to);
  void facets(std::span<const Triangle> list);
};

class Refinement {
 public:
  // Copies `parameters` and `free_box`; keeps references to the rest.
  Refinement(SurfaceMesh& surface_mesh, const Isosurface& surface, const BoundaryCurves& curves,
             const Parameters& parameters, Report& report, const FreeBox& free_box = {});

  SurfaceMesh& s;
  TriMesh& mesh;
  const Isosurface& surface;
  const BoundaryCurves& curves;
  Parameters parameters;  // the bound on the distance gives way to target_vertices
  Report& report;
  Observer* const observer;            // null unless it follows insertions
  const Question* question = nullptr;  // with an observer: the one that operations answer
  const FreeBox free_box;
  // Vertices from this one on were inserted by this refinement; collapses leave them.
  const std::size_t inserted;
  SurfacePointFinder finder;
  Proposal proposal;  // the last one
  // Of a vertex, in this refinement. Moves are vain where every place was refused, until a facet at
  // the vertex changes.
  struct Moves {
    std::uint8_t tries = 0;
    bool are_vain = false;
  };
  std::vector<Moves> moves;  // grows on demand

  // Return facets in one scratch array, valid until the next of these calls: those around v, a
  // corner of f; and E, those connected to `start` whose surface balls hold p.
  std::span<const FaceId> star(FaceId f, VertexId v);
  std::span<const FaceId> encroached(FaceId start, const Vec3& p);

  // Proposes to replace `cavity`. Returns `proposal`, or null if the cavity is not a disk.
  // `least_cosine`: see Proposal.
  Proposal* propose(std::span<const FaceId> cavity, double least_cosine = kSharpestFold);
  // Makes the proposal and returns nullopt, or returns the test that refuses it and changes
  // nothing. accept() is true while the operation can still lower its quantity. It is called when
  // the vertex is in its place: first without duals of the new facets, then after each new dual.
  // After a refusal the cavity can be filled in another way. pre: propose().
  template <class Accept>
  std::optional<Refusal> replace(Accept&& accept) {
    Proposal& c = proposal;
    if (leaves_free_box(c)) return Refusal::frozen;
    put_in_place(c);
    if (!c.knows_duals) c.duals.clear();
    std::optional<Refusal> refusal = test_shape(c);
    if (!refusal && !accept()) refusal = Refusal::no_gain;
    for (std::ptrdiff_t allowed = facets_without_point(c); !refusal && !c.has_duals();) {
      refusal = !find_dual(c, allowed) ? std::optional(Refusal::no_surface_point)
                : !accept()            ? std::optional(Refusal::no_gain)
                                       : std::nullopt;
    }
    if (!refusal && uncovers(c)) refusal = Refusal::uncovers;
    if (!refusal && crosses(c)) refusal = Refusal::crossing;
    refusal ? undo(c) : commit(c);
    return refusal;
  }
  // The same for operations with no quantity to lower.
  std::optional<Refusal> replace() {
    return replace([] { return true; });
  }

  // Counts the outcome of an operation, reports it to the observer with what was proposed since the
  // last outcome, and returns it. pre: a Question, if there is an observer.
  std::optional<Refusal> done(Operation operation, std::optional<Refusal> refusal);
  std::span<const FaceId> created() const { return proposal.created; }

  FacetShape shape(const Triangle& v, const Dual& dual) const { return s.shape(v, dual); }
  FacetShape shape(FaceId f) const { return shape(mesh.faces[f].v, s.duals[f]); }
  // Returns the cost of a facet; it is bad above 1.
  double violation(const Triangle& v, const Dual& dual) const {
    return deliso::violation(shape(v, dual), parameters.refinement);
  }
  // True if the facet has a surface point and no mesh vertex is in its surface ball.
  // `ignored`: a vertex that may be there.
  bool is_delaunay(const Triangle& v, const Dual& dual, VertexId ignored = kNoId) const;
  bool is_delaunay(FaceId f) const { return is_delaunay(mesh.faces[f].v, s.duals[f]); }
  // Calls visit(v) for the vertices that are no corner of f and may be within the gap of it: those
  // within the gap of its ball, which holds it.
  template <class Visit>
  void for_each_vertex_near(FaceId f, Visit&& visit) const {
    const Dual& dual = s.duals[f];
    const double radius = std::sqrt(dual.radius2) + parameters.gap;
    vertices_.any<VertexId>(vertices_.box_around(dual.center, radius), [&](VertexId v,
                                                                           const BoxGrid::Box&) {
      if (distance2(point(v), dual.center) < radius * radius && !has_corner(mesh.faces[f].v, v)) {
        visit(v);
      }
      return false;
    });
  }
  bool is_frozen(FaceId f) const { return f < free_box.first_free; }
  const BoxGrid& facets() const { return facets_; }
  const Vec3& point(VertexId v) const { return mesh.points[v]; }
  Vec3 normal(const Triangle& v) const {
    return area_normal(point(v[0]), point(v[1]), point(v[2]));
  }

 private:
  bool leaves_free_box(const Proposal& c) const;
  void put_in_place(const Proposal& c);
  void undo(const Proposal& c);
  void commit(Proposal& c);

  // refine/gates.cpp
  std::optional<Refusal> test_shape(Proposal& c);  // G1 and G2
  // G3 for the next facet of `in`: finds its dual. False if more facets lack a surface point than
  // `allowed`.
  bool find_dual(Proposal& c, std::ptrdiff_t& allowed);
  // Returns how many facets of the cavity above r_min lack one: `in` may have the same number.
  std::ptrdiff_t facets_without_point(const Proposal& c) const;
  bool keeps_manifold(Proposal& c);
  bool is_joined_outside(VertexId a, VertexId b, const Proposal& c);
  // True if an edge between them would lie in an inner face of the block: only the seam does.
  bool joins_on_seam(VertexId a, VertexId b) const;
  double sharpest_edge(const Disk& disk, std::span<const Vec3> normals,
                       std::span<const FaceId> across) const;
  bool folds(const Proposal& c) const;
  bool reverses(Proposal& c);
  bool uncovers(const Proposal& c) const;  // G4
  bool faces_out(const Triangle& v, const Vec3& normal) const;
  bool is_needle(const Proposal& c) const;
  bool crosses(const Proposal& c);
  Vec3 point_before(const Proposal& c, VertexId v) const {
    return c.what == Proposal::Vertex::moves && v == c.vertex ? moved_from_ : point(v);
  }
  bool is_small(const Dual& dual) const {
    return dual.radius2 <= parameters.r_min * parameters.r_min;
  }

  bool is_in_cavity(FaceId f) const { return marks_[f] == stamp_; }

  BoxGrid facets_, vertices_;
  IdArray<FaceId, std::uint32_t> component_;   // per facet, the component that has it
  std::vector<std::uint32_t> component_size_;  // facets of each

  // Of the current proposal.
  bool is_open_ = false;              // its outcome is not counted yet
  std::vector<std::uint32_t> marks_;  // per facet: stamp_ if it is in the cavity
  std::uint32_t stamp_ = 0;
  Vec3 moved_from_;
  std::vector<FaceId> across_;  // per boundary edge of the new disk; kNoId on the mesh's boundary
  std::vector<FaceId> rest_;    // facets of a small component outside the cavity
  std::vector<Vec3> normals_;
  DiskCrossing crossing_;
  std::vector<FaceId> around_;  // of star() and encroached()
  std::vector<FaceId> star_;
};

// Why the operations of a scope are tried, for the observer. Refinement::done() demands one, so no
// outcome is reported with the reason of another. Without an observer it is empty.
class Question {
 public:
  Question(Refinement& r, FaceId f, Reason why) : r_(r) {
    if (r.observer) ask(f, why);
  }
  Question(Refinement& r, VertexId v, Reason why) : r_(r) {
    if (r.observer) ask(v, why);
  }
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;
  ~Question() { r_.question = nullptr; }

  Reason reason = Reason::beginning;
  double value = std::numeric_limits<double>::quiet_NaN();  // the facet's violation of the
                                                            // criterion, or its circumradius
  Triangle corners{kNoId, kNoId, kNoId};                    // of the facet; or the vertex alone
  Dual dual;                                                // of the facet

 private:
  void ask(FaceId f, Reason why);
  void ask(VertexId v, Reason why);

  Refinement& r_;
};

}  // namespace deliso
