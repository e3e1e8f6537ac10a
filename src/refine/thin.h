// SPDX-License-Identifier: MIT
// Removes vertices that the criteria do not need. Stage 1 has removed most of them. But insertion
// overshoots: where Stage 2 changed the mesh, some are not needed in the end.
//
// A vertex goes as in Stage 1 (surface/hole.h), if besides all facets that fill its hole meet the
// criteria and are Delaunay, by their surface balls.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "refine/refinement.h"
#include "surface/hole.h"
#include "surface/ring.h"

namespace deliso {

class Thinning {
 public:
  // Keeps a reference to r. `vertices` may be removed, and so may those that were inserted since r
  // was made.
  Thinning(Refinement& r, std::span<const VertexId> vertices);

  // True if a vertex waits: it was not tried yet, or a facet around it has changed since.
  bool has_next() const { return !waiting_.empty(); }
  // Tries to remove the next vertex, and counts the outcome. After a success r.created() are the
  // new facets.
  std::optional<Refusal> remove_next();

 private:
  enum class State : std::uint8_t { stays, waits, refused };

  void wait(VertexId v);
  std::optional<Refusal> remove(VertexId v);
  Refinement& r_;
  const FacetTest test_;
  std::vector<VertexId> waiting_;  // the last is the next
  IdArray<VertexId, State> state_;
  IdArray<VertexId, FaceId> facet_;  // one at the vertex, or kNoId
  Ring ring_;                        // of the vertex that is tried
  Hole hole_;
};

}  // namespace deliso
