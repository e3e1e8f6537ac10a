// SPDX-License-Identifier: MIT
// Seams: where Sigma meets the faces that a block of a volume shares with others. The blocks at a
// face are meshed independently. Their meshes fit together because of J1 and J2.
//   J1  The vertices on an inner face are some of the crossings of the face's grid edges. The edges
//       run from one to the next along the curve. The choice depends on the samples of the face
//       alone (blocks/choose_seams.h). Coordinates are the same to the last bit
//       (volume/volume.h).
//   J2  Nothing else of the mesh lies in the face: no other vertex, edge or facet. So the meshes
//       share the seam and no more.
#pragma once

#include <optional>
#include <tuple>

#include "mesh/tri_mesh.h"
#include "surface/boundary.h"
#include "surface/surface_mesh.h"
#include "volume/volume.h"

namespace deliso {

// The edge from sample `low` of the whole volume along `axis`.
struct GridEdge {
  int axis = 0;
  Index3 low;
  auto key() const { return std::tuple(axis, low.i, low.j, low.k); }
};

// Returns the grid edge that p lies on, between its ends; nothing if it lies on none.
std::optional<GridEdge> grid_edge_at(const Vec3& p, const Volume& volume);

// Returns the inner faces at which J1 or J2 fails. pre: `curves` are of the mesh's chain.
unsigned faulty_faces(const SurfaceMesh& mesh, const BoundaryCurves& curves, const Volume& block);

}  // namespace deliso
