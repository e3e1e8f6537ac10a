// SPDX-License-Identifier: MIT
// The values of --attributes.
#pragma once

#include "io/mesh/write_mesh.h"
#include "run/report.h"
#include "volume/volume.h"

namespace deliso {

// Returns the values of a mesh of mesh_isosurface():
// - Normals run against the gradient of the volume's interpolant. Where that is 0 or runs into the
//   mesh, and at the caps' own vertices, they are the mean of the facets' normals.
// - Components are those of facet_components(), of surface and caps together.
// - Distances are those of facet_distances(), at most the length of its search; 0 of caps.
// `surface`: the mesh without caps, over the same points.
MeshAttributes mesh_attributes(const TriMesh& mesh, const TriMesh& surface, const Volume& volume,
                               const Report& report, int threads);

// Returns the normal in the world, of any length: axes need not be at right angles.
Vec3 normal_in_world(const Vec3& normal, const Frame& frame);

}  // namespace deliso
