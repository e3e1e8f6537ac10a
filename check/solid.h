// SPDX-License-Identifier: MIT
// A mesh closed on the box (--cap), split in two: caps are the triangles with all corners on one
// face of the box, the surface is the rest.
#pragma once

#include <cstddef>
#include <vector>

#include "base/box3.h"
#include "check/faults.h"
#include "mesh/tri_mesh.h"

namespace deliso {

struct SolidParts {
  TriMesh surface;                 // over all vertices of the mesh
  std::vector<FaceId> surface_id;  // ids in the mesh of the surface's triangles
  TriMesh caps;
  std::vector<bool> is_cap;  // per triangle of the mesh
  double volume = 0;         // enclosed by all triangles; negative if they face inwards
};

// Splits a solid into surface and caps. Reports caps that face into the box, and a mesh whose
// volume is not positive, into `faults`. pre: coordinates are finite.
SolidParts split_solid(const TriMesh& mesh, const Box3& box, Faults& faults);

}  // namespace deliso
