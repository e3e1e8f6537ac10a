// SPDX-License-Identifier: MIT
// Merges vertices of a mesh until a number of vertices or triangles is left. A vertex is merged
// into a neighbor, so all vertices stay on Sigma. Each removal is an operation of
// Stage 2 and passes its gates, so the topology stays, and no two facets cross. Where no other
// removal is left, bad shapes are allowed first, then facets without a surface point (G3).
//
// Passes of four phases: pick the cheapest merge of each vertex; take the cheapest of them all;
// sort these; perform them. A vertex whose facets changed in a pass waits for the next one.
//
// The cost is the larger of two, each an area times a squared distance. The first is the quadric
// error of Garland and Heckbert 1997: distances from the planes of the facets that the vertex
// stands for, each times its facet's area. The second is the distance of the vertex from the facets
// that come, times the mean area of a facet. Without it, Sigma's largest distance from the mesh is
// 1.1 (noise) to 3.4 times (ENGINE) as large.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "refine/refinement.h"
#include "run/options.h"

namespace deliso {

// Removes vertices until no more than `vertices` and `triangles` are left, or until no removal
// passes the gates. A finite bound on the distance is kept, by G4: it may leave many more vertices.
// Returns how many vertices are left. A removal takes away two triangles, or one on the boundary,
// so one triangle less than asked for may be left. pre: every vertex has a facet.
std::size_t merge_vertices(Refinement& r, std::size_t vertices,
                           std::size_t triangles = std::numeric_limits<std::size_t>::max());

// The same, and moves vertices by up to `within` off Sigma (more/counts/free_vertices.h). Merges
// and moves alternate from twice the numbers on: the facets that a merge weighs then lie where they
// will.
void merge_and_free(Refinement& r, std::size_t vertices, std::size_t triangles, double within);

// Returns how far the sample is from the mesh that is furthest from it. `resolution`: where the
// search for a nearest facet begins, about as large as most distances.
double furthest_distance(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples,
                         double resolution);

// Merges vertices down to the desired numbers of the options, without a bound on the distance, and
// keeps facets apart (refine/separate.h). Sets report.max_distance to the distance of the sample
// that is furthest from the mesh then.
void merge_to_count(SurfaceMesh& mesh, std::span<const Vec3> samples, const Options& options,
                    const Given& given);

}  // namespace deliso
