// SPDX-License-Identifier: MIT
// A field between the stages, with what Stage 2 asks for.
#pragma once

#include <algorithm>
#include <vector>

#include "contour/contour.h"
#include "deliso/deliso.h"
#include "deliso/options.h"
#include "io/volume/builtin_volume.h"

namespace deliso::guide {

// For delaunay_mesh(): Stage 1 alone.
inline Options stage1_only() {
  Options options;
  options.stop_after_stage1 = true;
  return options;
}

struct Handed {
  Volume volume;
  double kappa;
  ContourMesh contour;
  Isosurface surface;
  Parameters parameters;
  Report report;
  DelaunayMesh coarsened;

  Handed(const char* field, double isovalue, const Options& options)
      : volume(make_builtin_volume(field)),
        kappa(geometric_isovalue(volume.type(), isovalue)),
        contour(build_contour(volume, kappa)),
        surface(volume, kappa),
        parameters(resolve(options, volume)),
        coarsened(delaunay_mesh(surface, ContourMesh(contour), stage1_only(), parameters, report)) {
  }

  Given given() { return {surface, coarsened.curves, parameters, report}; }
};

}  // namespace deliso::guide
