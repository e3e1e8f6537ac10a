// SPDX-License-Identifier: MIT
// Vertices moved along Sigma. Where every insertion is refused and no flip helps, it is the
// vertices that stand badly: a facet stays over a limit, or outside the restricted Delaunay
// triangulation, which a corner a fraction of r_min further on would mend. (Refinement and moves
// taken together: Tournois, Wormser, Alliez and Desbrun 2009.) What falls is the cost of the facets
// around.
#pragma once

#include <vector>

#include "refine/judge.h"
#include "refine/replace_disk.h"

namespace deliso {

class Mover {
 public:
  // Keeps references.
  Mover(SurfaceMesh& surface_mesh, DiskReplacer& replacer, const Judge& judge,
        const Parameters& parameters, Report& report)
      : s_(surface_mesh),
        mesh_(surface_mesh.mesh),
        replacer_(replacer),
        judge_(judge),
        parameters_(parameters),
        report_(report) {}

  // Moves a corner of f to where the facets around it, and those beyond them, cost least. Vertices
  // on the boundary stay.
  bool move_corner(FaceId f);
  std::span<const FaceId> created() const { return change_.created; }

 private:
  bool move(FaceId f, VertexId v);
  double cost_of_needles(const Vec3& p) const;

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  DiskReplacer& replacer_;
  const Judge& judge_;
  const Parameters& parameters_;
  Report& report_;
  Change change_;
  std::vector<FaceId> watched_;  // beyond the star
};

}  // namespace deliso
