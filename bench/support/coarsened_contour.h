// SPDX-License-Identifier: MIT
// Stage 1 of the exact program on a whole volume, for benchmarks, figures and tests of Stage 2.
#pragma once

#include "blocks/mesh_in_blocks.h"
#include "isosurface/isosurface.h"
#include "run/options.h"

namespace deliso {

// Returns the coarsened contour, in one block, with its reference samples.
inline Block coarsened_contour(const Isosurface& surface, const Parameters& parameters) {
  const VolumeSource source = source_of(surface.volume());
  Options options;
  options.block_side = 0;
  options.stop_after_stage1 = true;
  return mesh_in_blocks({source, surface.kappa(), options, parameters}, {}, {});
}

}  // namespace deliso
