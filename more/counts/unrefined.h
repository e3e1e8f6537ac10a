// SPDX-License-Identifier: MIT
// How far a finished mesh is from what was asked.
#pragma once

#include "run/parameters.h"
#include "run/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Sets report.largest_h, the bound on the distance, and the count of facets over a limit.
void count_unrefined(const SurfaceMesh& mesh, const Parameters& parameters, Report& report);

}  // namespace deliso
