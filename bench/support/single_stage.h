// SPDX-License-Identifier: MIT
// The baseline of Table 2: all refinement on Del S, with RefineGeom's criteria and no Stage 2.
#pragma once

#include "paper/deliso.h"

namespace deliso {

// Returns the mesh as paper::deliso() does: Del S|Sigma, when Recover's tests and Refine's criteria
// hold on it. The pole height of a new vertex is the mean of those adjacent in Del S|Sigma (§3.2).
// `observer` and `stop_after_recover` of the options mean nothing here.
TriMesh single_stage_deliso(const Volume& volume, double isovalue, const paper::Options& options,
                            paper::Report& report);

}  // namespace deliso
