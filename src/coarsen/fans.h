// SPDX-License-Identifier: MIT
// Vertices around which facets lie side by side. Such facets do not cross.
#pragma once

#include <cstdint>

#include "mesh/tri_mesh.h"

namespace deliso {

// Marks the vertices whose facets close up around them and lie side by side, seen along the sum of
// their area normals, with a margin above rounding. `normals`: of the live facets.
IdArray<VertexId, std::uint8_t> stars_that_are_fans(const TriMesh& mesh,
                                                    const IdArray<FaceId, Vec3>& normals);

}  // namespace deliso
