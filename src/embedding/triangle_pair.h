// SPDX-License-Identifier: MIT
// The exact intersection test of two triangles of a mesh. Every decision is a sign of orient3d
// (Shewchuk 1997). In a common plane, a fourth point off the plane makes orient3d the orientation
// within it.
#pragma once

#include "base/vec3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Voxels. How far vertices are moved where they, or triangles, would touch: well within the allowed
// distance of a vertex from Sigma.
inline constexpr double kPerturbationVoxels = 1e-7;

// True if the closed segment pq and the closed triangle abc have a point in common.
// pre: a, b, c are not collinear.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                            const Vec3& c);

// True if the closed triangles s and t have a point in common outside the vertex or edge that they
// share. Vertices are the same if their ids are. Two triangles on the same three vertices do meet.
// pre: neither is degenerate; different ids have different positions.
bool triangles_intersect(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t);

}  // namespace deliso
