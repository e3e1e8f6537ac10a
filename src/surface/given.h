// SPDX-License-Identifier: MIT
// The surface, its curves on the box, the parameters and the report, for a stage.
#pragma once

#include "isosurface/isosurface.h"
#include "run/parameters.h"
#include "run/report.h"
#include "surface/boundary.h"

namespace deliso {

// What a stage is given beside the mesh that it changes. It keeps references.
struct Given {
  const Isosurface& surface;
  const BoundaryCurves& curves;  // of the mesh's chain
  const Parameters& parameters;
  Report& report;  // counts and seconds are added to it
};

}  // namespace deliso
