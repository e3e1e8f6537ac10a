// SPDX-License-Identifier: MIT
// Ambient occlusion: how much of the sky each vertex sees. Places between sheets are dark, so that
// parts in front of each other can be told apart. The sky is some directions, evenly spread. From
// each of them the mesh is drawn into a small z-buffer (rasterize.h).
//
//   A1  The result does not depend on the number of threads.
#pragma once

#include <span>
#include <vector>

#include "view/render/camera.h"

namespace deliso {

// Shares of the sky, weighted by the cosine to the normal, from 0 to 1.
struct SkySeen {
  float outside = 1, inside = 1;  // by a vertex of the side where f < kappa, and of the other side
};

// Returns one entry per vertex of the subject's mesh. What is clipped hides nothing. `normals`: of
// the vertices, of unit length or zero. Throws as fit_camera.
std::vector<SkySeen> find_sky(const Subject& subject, std::span<const Vec3> normals, int threads);

}  // namespace deliso
