// SPDX-License-Identifier: MIT
// Whether two triangles of a mesh meet where they should not, exactly: every decision is a sign of
// orient3d (Shewchuk 1997), also in a common plane, where a fourth point off the plane makes
// orient3d the orientation within it.
#pragma once

#include "base/vec3.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// How far vertices are moved where they, or triangles, would touch, in voxels: well within what a
// vertex may be off Sigma.
inline constexpr double kHair = 1e-7;

// Whether the closed segment pq and the closed triangle abc have a point in common.
// pre: a, b, c not on one line.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                            const Vec3& c);

// Whether the closed triangles s and t have a point in common beyond the vertex or edge that they
// share; vertices are the same when their ids are. Two triangles on the same three vertices do.
// pre: neither is degenerate; different ids have different positions.
bool triangles_intersect(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t);

}  // namespace deliso
