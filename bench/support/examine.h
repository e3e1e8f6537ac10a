// SPDX-License-Identifier: MIT
// What is wrong with a finished mesh, for the studies: shape criteria and topology, without the
// cost of the full verifier.
#pragma once

#include <cstddef>
#include <cstdint>

#include "contour/contour.h"
#include "mesh/tri_mesh.h"
#include "support/datasets.h"

namespace deliso {

struct Examined {
  std::size_t over_lambda = 0;    // facets above r_min with r/l > lambda
  std::size_t over_h_over_r = 0;  // and with h/r > epsilon1
  std::size_t components = 0;
  std::int64_t euler = 0;
  // The components' Euler numbers and boundary loops, all together, are those of the contour.
  bool topology_exact = false;
};

// `mesh` is one of `opened` at the isovalue kappa. h is that of facets' surface points, and r where
// there is none.
Examined examine(const TriMesh& mesh, const OpenedDataset& opened, const ContourSummary& exact,
                 double kappa, double lambda, double epsilon1, double r_min);

ContourSummary exact_topology(const OpenedDataset& opened);

}  // namespace deliso
