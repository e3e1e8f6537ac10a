// SPDX-License-Identifier: MIT
// The paper's tests (§3.1) lose components: one that lies within its own Voronoi cells meets no
// Voronoi edge, so no test sees it, and one smaller than r_min falls to the cancelling of close
// hits. The exact contour knows them all; what the handed-over mesh lacks is put back from it.
#pragma once

#include "contour/contour.h"
#include "isosurface/isosurface.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Adds the pieces of T for every kept component that no component of the mesh stands for, and
// counts them. A mesh component stands for the component that most of its vertices were seeded
// from. source: per vertex of the mesh, the one of the triangulation. contour_component: per vertex
// of the triangulation, the component it was seeded from; kNoId for points of other origin. kept:
// per component of T.
void put_back_lost_components(SurfaceMesh& recovered, const std::vector<VertexId>& source,
                              const ContourMesh& contour,
                              const std::vector<std::uint32_t>& contour_component,
                              const std::vector<std::uint8_t>& kept, const Isosurface& surface,
                              Report& report);

}  // namespace deliso
