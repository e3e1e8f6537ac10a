// SPDX-License-Identifier: MIT
// The normals that c/deliso.h tells of.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "blocks/block.h"
#include "mesh/tri_mesh.h"
#include "run/options.h"

namespace deliso::c {

// Returns the normal at each vertex, in the world. `field`: what was meshed with the options; it is
// read block by block, with a sample around.
std::vector<Vec3> normals_of(const TriMesh& mesh, const VolumeSource& field,
                             const Options& options);

}  // namespace deliso::c
