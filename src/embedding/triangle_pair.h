// SPDX-License-Identifier: MIT
// The exact intersection test of two triangles of a mesh. Every decision is a sign of orient3d
// (Shewchuk 1997). In a common plane, a fourth point off the plane makes orient3d the orientation
// within it.
#pragma once

#include <cmath>

#include "base/vec3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Voxels. How far vertices are moved where they, or triangles, would touch: well within the allowed
// distance of a vertex from Sigma.
inline constexpr double kPerturbationVoxels = 1e-7;

// Returns the sum of the coordinates' sizes: a bound on the length that costs no root.
inline double sum_of_sizes(const Vec3& a) {
  return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z);
}

// True if a plane through a side of s, at a right angle to s, separates the triangles: t lies
// beyond it and s does not, except corners that both share, by a margin far above rounding. So they
// do not cross. `normal`: the area normal of s.
bool is_separated(const std::vector<Vec3>& points, const Triangle& s, const Vec3& normal,
                  const Triangle& t);

// True if the closed triangles s and t have a point in common outside the vertex or edge that they
// share. Vertices are the same if their ids are. Two triangles on the same three vertices do meet.
// pre: neither is degenerate; different ids have different positions.
bool triangles_intersect(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t);

}  // namespace deliso
