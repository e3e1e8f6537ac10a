// SPDX-License-Identifier: MIT
// Removes vertices that the criteria do not need. Stage 1 has removed most of them. But insertion
// overshoots: where Stage 2 changed the mesh, some are not needed in the end.
//
// A vertex goes if the Delaunay triangulation of its hole can take the place of its facets: all of
// the new ones meet the criteria and are Delaunay, by their surface balls, and the vertex lies
// within the bound on the distance from one of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "refine/refinement.h"

namespace deliso {

class Thinning {
 public:
  // Keeps a reference to r. `vertices` may be removed, and so may those that were inserted since r
  // was made.
  Thinning(Refinement& r, std::span<const VertexId> vertices);

  // True if a vertex waits to be tried: none was, or a facet around it has changed since.
  bool has_next() const { return !waiting_.empty(); }
  // Tries to remove the next vertex, and counts the outcome. After a success r.created() are the
  // new facets.
  std::optional<Refusal> remove_next();

 private:
  struct NewFacet {
    Triangle corners;
    double radius2;
  };
  enum class State : std::uint8_t { stays, waits, refused };

  void wait(VertexId v);
  std::optional<Refusal> remove(VertexId v);
  // Sets star_, and ring_ to the neighbors in order. Facet k lies between neighbors k and k + 1.
  void walk_around(VertexId v);
  // Triangulates the part of the hole between neighbors i and j and the edge that joins them. False
  // if a facet would turn over or violate r/l.
  bool fill(std::size_t i, std::size_t j);
  // True if Sigma, facing as the facet does, crosses the facet's dual line within the bound on the
  // distance. Two values of g say so; a surface point costs ten times as much.
  bool has_surface_near(const Triangle& facet) const;

  Refinement& r_;
  std::vector<VertexId> waiting_;  // the last is the next
  IdArray<VertexId, State> state_;
  IdArray<VertexId, FaceId> facet_;  // one at the vertex, or kNoId
  // Of the vertex that is tried.
  std::vector<FaceId> star_;
  std::vector<VertexId> ring_;
  Vec3 normal_;
  std::vector<NewFacet> filling_;
};

}  // namespace deliso
