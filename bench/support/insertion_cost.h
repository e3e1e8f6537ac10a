// SPDX-License-Identifier: MIT
// What an insertion of the published program is made of, measured from outside: a run in which an
// observer makes every search once more, on the clock. So src/paper needs no clock in its loops.
#pragma once

#include "paper/options.h"
#include "support/datasets.h"

namespace deliso {

// Means over all insertions of a stage.
struct InsertionCost {
  double searches = 0;
  double search_seconds = 0;  // all of these searches
  double other_seconds = 0;   // Del S or the mesh, queues, tests
};
struct InsertionCosts {
  InsertionCost recover, refine;
};

// Runs both stages. pre: no hits are kept.
InsertionCosts measure_insertions(const OpenedDataset& opened, paper::Options options);

}  // namespace deliso
