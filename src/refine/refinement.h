// SPDX-License-Identifier: MIT
// The state of Stage 2 and its one change: another disk over the same boundary replaces a disk of
// facets, the cavity. Insertion, flip, collapse and move (refine/operations.h) and removal
// (refine/thin.h) propose such changes (refine/proposal.h), each with what the gates below ask. On
// the mesh's boundary the boundary of the cavity may change too, between two boundary vertices.
//
// The mesh of Stage 1 is a manifold, homeomorphic to Sigma, embedded, with its vertices on Sigma.
// Every replacement keeps that, because it passes these tests, the gates, from cheap to expensive:
// Refinement::make() asks them. A proposal may do without some (Gates in refine/proposal.h), but
// never without G0, G1 and the crossings of G5. Only moves of refine/separate.h, and where asked of
// more/counts/free_vertices.h, take vertices off Sigma.
//   G0  No frozen facet is removed. A vertex comes or moves only to places in the free box, and to
//       no face of the box but those of its chain (S3). The free box is a block without its inner
//       faces (FreeBox::within). Where a part of a mesh is refined (blocks/seams.h), it is the
//       part's box, and facets outside are frozen.
//   G1  Both are disks, and no new facet or edge is in the mesh already (the link condition), or
//       would lie in a face of the box (S3). So the mesh stays a manifold. Its topology stays if
//       the boundaries of the two disks differ in at most one run of the mesh's boundary edges; the
//       operation must ensure that (docs/proof.md).
//   G2  No small component is reversed. No edge is folded more sharply than the proposal's limit,
//       or than one was before; insertions and boundary splits have no limit.
//   G3  New facets have surface points. Those below r_min that face Sigma's outside may lack one;
//       of the others, no more than before. A vertex comes or moves only to a point of the sheet
//       that the cavity is on (contour/sheet_walk.h), so each stays on its component.
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
#include <type_traits>
#include <utility>
#include <vector>

#include "embedding/box_grid.h"
#include "embedding/disk_crossing.h"
#include "refine/proposal.h"
#include "run/observer.h"
#include "surface/free_box.h"
#include "surface/given.h"
#include "surface/surface_mesh.h"
#include "surface/surface_point.h"

namespace deliso {

class Refinement {
 public:
  // Copies the parameters and `free_box`; keeps references to the rest.
  Refinement(SurfaceMesh& surface_mesh, const Given& given, const FreeBox& free_box = {});

  SurfaceMesh& s;
  TriMesh& mesh;
  const Isosurface& surface;
  const BoundaryCurves& curves;
  Parameters parameters;
  Report& report;
  Observer* const observer;            // null unless it follows insertions
  const Question* question = nullptr;  // with an observer: the one that operations answer
  const FreeBox free_box;
  // Vertices from this one on were inserted by this refinement; collapses leave them.
  const std::size_t inserted;
  SurfacePointFinder finder;
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

  // Returns the cavity of these facets, or null if they are not a disk. It is the only one until
  // the next call, and ends when a proposal for it is made.
  const Cavity* open(std::span<const FaceId> facets);
  // What the operation itself asks: a refusal, or nullopt while it can still lower its quantity. A
  // function that returns false stands for no_gain. It refers to a function of the caller.
  class Accept {
   public:
    template <class Function>
    Accept(const Function& function)
        : function_(&function),
          call_([](const void* f, const Replacement& c) -> std::optional<Refusal> {
            const auto answer = (*static_cast<const Function*>(f))(c);
            if constexpr (!std::is_same_v<decltype(answer), const bool>) {
              return answer;
            } else if (!answer) {
              return Refusal::no_gain;
            }
            return std::nullopt;
          }) {}
    std::optional<Refusal> operator()(const Replacement& c) const { return call_(function_, c); }

   private:
    const void* function_;
    std::optional<Refusal> (*call_)(const void*, const Replacement&);
  };
  static constexpr auto always = [](const Replacement&) { return true; };
  // Makes the proposal and returns nullopt, or returns the test that refuses it and changes
  // nothing. accept() is called when the vertex is in its place: first without duals of the new
  // facets, then after each new dual. pre: the proposal is one of the open cavity.
  std::optional<Refusal> make(Proposal proposal, const Accept& accept = always);

  // Counts the outcome of an operation, reports it to the observer with what was tried since the
  // last outcome, and returns it. pre: a Question, if there is an observer.
  std::optional<Refusal> done(Operation operation, std::optional<Refusal> refusal);
  // Returns the last replacement, made or not, and the facets that it created.
  const Replacement& tried() const { return tried_; }
  std::span<const FaceId> created() const { return tried_.created; }

  FacetShape shape(const Triangle& v, const Dual& dual) const { return s.shape(v, dual); }
  FacetShape shape(FaceId f) const { return shape(mesh.faces[f].v, s.duals[f]); }
  // Returns how far a facet violates its worst criterion; it is bad above 1.
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
  bool leaves_free_box(const Replacement& c) const;  // G0
  void put_in_place(const Replacement& c);
  void undo(const Replacement& c);
  // Puts the new disk into the mesh, the chain and the hashes, in two steps.
  void commit(Replacement& c);
  void commit_vertices(const Replacement& c);
  void commit_facets(Replacement& c);

  // refine/gates.cpp
  std::optional<Refusal> test_shape(Replacement& c);  // G1, and G2: folds(), reverses()
  // G3 for the next facet of `in`: finds its dual. False if more facets lack a surface point than
  // `allowed`.
  bool find_dual(Replacement& c, std::ptrdiff_t& allowed);
  // Returns how many facets of the cavity above r_min lack one: `in` may have the same number.
  std::ptrdiff_t facets_without_point(const Replacement& c) const;
  bool keeps_manifold(Replacement& c);
  bool is_joined_outside(VertexId a, VertexId b, const Replacement& c);
  // A side of a frozen facet of another sheet, that ends where the mesh does (more/bodies).
  struct FrozenSide {
    std::pair<VertexId, VertexId> edge;  // the smaller number first
    VertexId apex;
  };
  std::span<const FrozenSide> frozen_at(VertexId a, VertexId b) const;
  bool is_joined_on_curves(VertexId a, VertexId b) const;
  bool passes_sheet(const Replacement& c) const;
  double sharpest_edge(const Disk& disk, std::span<const Vec3> normals,
                       std::span<const FaceId> across) const;
  bool folds(const Replacement& c) const;
  bool reverses(Replacement& c);
  bool leaves_sheet(const Replacement& c);    // G3
  bool uncovers(const Replacement& c) const;  // G4
  bool faces_out(const Triangle& v, const Vec3& normal) const;
  bool is_needle(const Replacement& c) const;
  bool crosses(const Replacement& c);  // G5, with is_needle()
  Vec3 point_before(const Replacement& c, VertexId v) const {
    return c.moves() && v == c.proposal.vertex ? moved_from_ : point(v);
  }
  bool is_small(const Dual& dual) const {
    return dual.radius2 <= parameters.r_min * parameters.r_min;
  }

  bool is_in_cavity(FaceId f) const { return marks_[f] == tried_.cavity.number_; }

  const Box3 box_, within_;  // of the volume
  BoxGrid facets_, vertices_;
  IdArray<FaceId, std::uint32_t> component_;   // per facet, the component that has it
  std::vector<std::uint32_t> component_size_;  // facets of each

  std::vector<FrozenSide> frozen_sides_;  // sorted
  Replacement tried_;
  bool is_counted_ = true;            // its outcome
  std::vector<std::uint32_t> marks_;  // per facet, the number of the last cavity that had it
  Vec3 moved_from_;
  std::vector<FaceId> rest_;  // facets of a small component outside the cavity
  std::vector<Vec3> normals_;
  DiskCrossing crossing_;
  std::vector<FaceId> around_;  // of star() and encroached()
  std::vector<FaceId> star_;
};

// Why the operations of a scope are tried, for the observer. Refinement::done() demands one, so no
// outcome is reported with the reason of another. Without an observer nobody asks for it.
class Question {
 public:
  Question(Refinement& r, FaceId f, Reason why) : r_(r) {
    if (r.observer) ask(f, why);
  }
  Question(Refinement& r, VertexId v, Reason why) : reason(why), corners{v, kNoId, kNoId}, r_(r) {
    if (r.observer) r.question = this;
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

  Refinement& r_;
};

}  // namespace deliso
