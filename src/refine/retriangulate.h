// SPDX-License-Identifier: MIT
// A flip of more than two facets: where no flip of an edge helps, a patch of facets is triangulated
// anew over the same rim and the same vertices, by facets whose surface balls are empty: a piece of
// the restricted Delaunay triangulation, found from the balls alone.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "refine/replace_disk.h"

namespace deliso {

class Retriangulator {
 public:
  // Keeps references.
  Retriangulator(SurfaceMesh& surface_mesh, DiskReplacer& replacer, Report& report)
      : mesh_(surface_mesh.mesh), replacer_(replacer), report_(report) {}

  // Replaces the patch of f and the facets with occupied balls that hang together with it, by one
  // that has none.
  bool retriangulate(FaceId f);
  std::span<const FaceId> created() const { return change_.created; }

 private:
  using DirectedEdge = std::pair<VertexId, VertexId>;

  bool in_patch(FaceId f) const;
  // Fills the patch facet by facet, closing the edges of front_ from number `from` on.
  bool fill();
  bool fill_from(std::size_t from);
  bool is_free(VertexId a, VertexId b) const;
  bool has_empty_ball(const Triangle& v);

  const TriMesh& mesh_;
  DiskReplacer& replacer_;
  Report& report_;
  Change change_;

  std::vector<VertexId> vertices_;  // of the patch
  // Of the patch; of the filling so far; to be closed.
  std::vector<DirectedEdge> rim_, used_, front_;
  std::map<Triangle, bool> empty_;
  int tried_ = 0;
};

}  // namespace deliso
