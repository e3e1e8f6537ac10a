// SPDX-License-Identifier: MIT
#include "surface/report.h"

namespace deliso {

void Report::add_refinement(const Report& part) {
  searches_refine += part.searches_refine;
  insertions_refine += part.insertions_refine;
  for (std::size_t r = 0; r < kRungs; ++r) {
    rungs[r].done += part.rungs[r].done;
    for (std::size_t k = 0; k < kRefusals; ++k) rungs[r].refused[k] += part.rungs[r].refused[k];
  }
}

}  // namespace deliso
