// SPDX-License-Identifier: MIT
// RefineGeom of paper Figure 9: a mesh, or a region of one, refined until every facet meets the
// criteria, by one queue, worst first. What is tried for a facet: refine/refine.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/refinement.h"

namespace deliso {

// In bounds on h: how much further than facets from Sigma, at their circumcenters, points of Sigma
// may be from the mesh. One limit for both costs two in five vertices more (docs/decisions.md).
inline constexpr double kCoverage = 2;

// Refines the facets that `open` holds and whatever changes. `far` are the numbers of the samples
// that may be too far from the mesh, and in the end of those that are. Returns facets for which
// something was refused for the sake of frozen ones. Throws InputError at max_vertices unless
// keep_partial.
std::vector<FaceId> refine_geom(Refinement& refinement, std::vector<FaceId> open,
                                std::span<const Vec3> samples, std::vector<std::uint32_t>& far);

}  // namespace deliso
