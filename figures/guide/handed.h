// SPDX-License-Identifier: MIT
// A field between the stages, with what Stage 2 asks for.
#pragma once

#include <algorithm>
#include <vector>

#include "blocks/mesh_in_blocks.h"
#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "run/options.h"
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
        coarsened(stage1()),
        curves(surface, coarsened.loops) {}

  Given given() { return {surface, curves, parameters, report}; }

 private:
  Block stage1() const {
    const VolumeSource source = source_of(volume);
    Options options;
    options.block_side = 0;
    options.stop_after_stage1 = true;
    return mesh_in_blocks({source, kappa, options, parameters}, {}, {});
  }
};

}  // namespace deliso::guide
