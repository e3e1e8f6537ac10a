// SPDX-License-Identifier: MIT
// What an insertion of the published program is made of, measured from outside: a run in which an
// observer makes every search once more, on the clock. So src/paper needs no clock in its loops.
#pragma once

#include "isosurface/isosurface.h"
#include "paper/options.h"
#include "support/datasets.h"

namespace deliso {

// Means over all insertions of a stage.
struct InsertionCost {
  double searches = 0;
  double search_seconds = 0;  // all of these searches
  double other_seconds = 0;   // Del S or the mesh, queues, tests
  // Recover's by the paper's definition (§6): the conflict zone, the cells, the searches. The rest
  // of other_seconds is queues, disks, criteria, and points that were not inserted.
  double insertion_seconds = 0;
};
struct InsertionCosts {
  InsertionCost recover, refine;
  // Recover's searches, those of S_0 included, if kappa is asked on pairs of voxels.
  SearchCounters by_pairs;
};

// Runs both stages.
InsertionCosts measure_insertions(const OpenedDataset& opened, paper::Options options);

}  // namespace deliso
