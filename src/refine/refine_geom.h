// SPDX-License-Identifier: MIT
// RefineGeom of paper Figure 9: a mesh, or a part of one, refined until every facet meets the
// criteria, by one queue, worst first. Which rungs are tried for a facet: refine/refine.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/parts.h"
#include "surface/parameters.h"
#include "surface/report.h"
#include "surface/stage_progress.h"
#include "surface/surface_mesh.h"

namespace deliso {

// What there is to do, and what is left of it.
struct Work {
  Part part;
  std::size_t of_stage1 = 0;  // so many vertices, the first ones, are Stage 1's
  // Per facet: nothing is to be done for it until something changes around it.
  std::vector<std::uint8_t> settled;
  // Which points of Sigma may be too far from the mesh: all, and later those that are.
  std::vector<std::uint32_t> far;
};

// How much further than facets from Sigma, at their circumcenters, points of Sigma may be from the
// mesh. The same for both costs two in five vertices more (docs/decisions.md).
inline constexpr double kReach = 2;

// Throws InputError at max_vertices unless keep_partial.
void refine_geom(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                 std::span<const Vec3> witnesses, const Parameters& parameters, Work& work,
                 StageProgress& progress, Report& report);

}  // namespace deliso
