// SPDX-License-Identifier: MIT
// Coarsens a mesh: fewer vertices, as far as the bound on the distance and the shapes of facets
// allow. Each change replaces a disk of facets by a disk with the same boundary:
//   - a vertex is removed, and its hole filled by the largest angle (surface/hole.h);
//   - a vertex moves to the middle of its star, and on to Sigma;
//   - an edge is flipped where the angles across it are too large.
// A change is refused by the link condition, by shape, or by distance both ways: the vertex that
// goes lies within the bound of the facet over it, and Sigma passes within the bound of each new
// facet's circumcenter. So the mesh stays a manifold of the same topology.
//
// It may come to cross itself, since no change asks. Who calls asks once, in the end
// (coarsen/embedding.h), which is cheaper (docs/decisions.md).
//
// It uses no random numbers. A change depends on the order of ids and on what is near it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coarsen/coarsen.h"
#include "coarsen/waiting_vertices.h"
#include "mesh/tri_mesh.h"
#include "run/observer.h"
#include "surface/facet_test.h"
#include "surface/given.h"
#include "surface/hole.h"
#include "surface/ring.h"
#include "surface/surface_point.h"

namespace deliso {

class Coarsener {
 public:
  // Keeps references. `distance`: the bound. `kept`: per vertex, nonzero if it stays where it is.
  Coarsener(SurfaceMesh& s, const Given& given, double distance, const CoarsenScope& scope,
            std::span<const std::uint8_t> kept);

  // Removes, moves and flips. Dead facets stay. Returns per facet 1 if it is new or a corner moved.
  std::vector<std::uint8_t> run();

 private:
  void remove_vertices();
  void move_vertices();
  void flip_edges();
  bool remove(VertexId v);
  void wake(VertexId v, VertexId changed) { waiting_.wake(v, changed, is_active_[v] != 0); }
  bool may_leave_boundary(VertexId v) const;
  bool keeps_link() const;
  void replace_star(VertexId v);
  bool move(VertexId v);
  void flip(FaceId f, int i);
  // Marks facets, and tells the observer.
  void note_change(Operation operation, VertexId v, std::span<const FaceId> facets);
  // Walks around v. False if a facet there is frozen.
  bool walk(VertexId v);
  // True if an edge joins a and b.
  bool joined(VertexId a, VertexId b) const;
  bool is_frozen(FaceId f) const { return f < scope_.free_box.first_free; }

  SurfaceMesh& s_;
  TriMesh& mesh_;
  BoundaryChain& chain_;
  const BoundaryCurves& curves_;
  const Box3 box_, within_;  // of the volume
  const FacetTest test_;
  const CoarsenScope& scope_;
  std::span<const std::uint8_t> kept_;
  std::vector<std::uint8_t> changed_;
  SurfacePointFinder finder_;
  SearchCounters& searches_;
  Observer* const observer_;                   // null unless it follows insertions
  IdArray<VertexId, FaceId> facet_;            // one at the vertex; kNoId: none
  IdArray<VertexId, std::uint8_t> is_active_;  // the vertex is in the scope, or near a change
  WaitingVertices waiting_;                    // for a try
  Ring ring_;
  Hole hole_;
};

}  // namespace deliso
