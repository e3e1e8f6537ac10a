// SPDX-License-Identifier: MIT
// A new vertex on an edge or in a facet of the plain mesh, with no regard to shape.
// Both keep I1..I5 of tri_mesh.h.
#pragma once

#include "mesh/tri_mesh.h"

namespace deliso {

// Splits the edge of f opposite its corner i at p; its one or two facets become two or four. Facet
// f keeps that corner and the edge's first end, as f runs along it. Returns the new vertex.
VertexId split_edge(TriMesh& mesh, FaceId f, int i, const Vec3& p);

// Splits f into three at p. Returns the new vertex.
VertexId split_face(TriMesh& mesh, FaceId f, const Vec3& p);

}  // namespace deliso
