// SPDX-License-Identifier: MIT
// A field between the stages, with what Stage 2 asks for.
#pragma once

#include <algorithm>
#include <vector>

#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "run/options.h"
#include "support/coarsened_contour.h"
#include "surface/given.h"

namespace deliso::guide {

struct Handed {
  Volume volume;
  double kappa;
  ContourMesh contour;
  Isosurface surface;
  Parameters parameters;
  Report report;
  Block coarsened;
  BoundaryCurves curves;

  Handed(const char* field, double isovalue, const Options& options)
      : volume(make_builtin_volume(field)),
        kappa(geometric_isovalue(volume.type(), isovalue)),
        contour(build_contour(volume, kappa)),
        surface(volume, kappa),
        parameters(resolve(options, volume)),
        coarsened(coarsened_contour(surface, parameters)),
        curves(surface, coarsened.loops) {}

  Given given() { return {surface, curves, parameters, report}; }
};

}  // namespace deliso::guide
