// SPDX-License-Identifier: MIT
// Seams: where Sigma meets the faces that a block of a volume shares with others. Both blocks at a
// face mesh what they hold by themselves, and their meshes fit together because
//   J1  the vertices on an inner face are some of the crossings of the face's own grid edges, and
//       the edges run from one to the next along the curve: which, that follows from the samples of
//       the face and the criteria alone (blocks/choose_seam.h), and coordinates are the same to
//       the last bit (volume/volume.h);
//   J2  nothing else lies in the face, neither a vertex nor an edge nor a facet, so that in it the
//       meshes have their seam in common and no more.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/seam_vertex.h"
#include "mesh/tri_mesh.h"
#include "surface/boundary.h"
#include "volume/volume.h"

namespace deliso {

// The grid edge that p lies on, between its ends; nothing when it lies on none.
std::optional<GridEdge> grid_edge_at(const Vec3& p, const Volume& volume);

// Throws InputError: what would have to go from a seam, for J1 or J2, cannot.
[[noreturn]] void refuse_seam(const std::string& what);

// The seam of a finished part, by ascending vertices, or refuse_seam(). pre: the mesh is linked.
std::vector<SeamVertex> seam_of(const TriMesh& mesh, const Volume& volume);

}  // namespace deliso
