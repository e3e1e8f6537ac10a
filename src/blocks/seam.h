// SPDX-License-Identifier: MIT
// Seams: where Sigma meets the faces that a block of a volume shares with others. The blocks at a
// face are meshed independently. Their meshes fit together because of J1 and J2.
//   J1  The vertices on an inner face are some of the crossings of the face's grid edges. The edges
//       run from one to the next along the curve. The choice depends on the samples of the face and
//       the criteria alone (blocks/choose_seam.h). Coordinates are the same to the last bit
//       (volume/volume.h).
//   J2  Nothing else of the mesh lies in the face: no other vertex, edge or facet. So the meshes
//       share the seam and no more.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/seam_vertex.h"
#include "mesh/tri_mesh.h"
#include "surface/boundary.h"
#include "volume/volume.h"

namespace deliso {

// Returns the grid edge that p lies on, between its ends; nothing if it lies on none.
std::optional<GridEdge> grid_edge_at(const Vec3& p, const Volume& volume);

// Throws InputError: `what` violates J1 or J2 and cannot be removed from a seam.
[[noreturn]] void refuse_seam(const std::string& what);

// Returns the seam of a finished block's mesh, by ascending vertices; calls refuse_seam() if J1 or
// J2 fails. pre: the mesh is linked.
std::vector<SeamVertex> seam_of(const TriMesh& mesh, const Volume& volume);

}  // namespace deliso
