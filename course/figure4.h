// SPDX-License-Identifier: MIT
// What the last exercise makes: the program of the paper's Figure 4.
#pragma once

#include "mesh/tri_mesh.h"
#include "paper/options.h"
#include "volume/volume.h"

namespace deliso::course {

// Returns the mesh of {g = kappa}: T_S2 of Figure 4, or, with `stop_after_recover`, Del S_1|Sigma.
// Facets are counter-clockwise seen from g < kappa. Of the options it heeds epsilon, epsilon1,
// epsilon2, lambda, r_min, lines, seed, solver and stop_after_recover. pre: some line meets Sigma.
TriMesh figure4(const Volume& volume, double kappa, const paper::Options& options);

}  // namespace deliso::course
