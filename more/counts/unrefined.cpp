// SPDX-License-Identifier: MIT
#include "more/counts/unrefined.h"

#include <algorithm>
#include <cstdint>

namespace deliso {

void count_unrefined(const SurfaceMesh& s, const Parameters& parameters, Report& report) {
  std::uint64_t over_limit = 0;
  report.largest_h = 0;
  for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
    if (is_dead(s.mesh.faces[f])) continue;
    const FacetShape shape = s.shape(s.mesh.faces[f].v, s.duals[f]);
    if (shape.r > parameters.r_min) report.largest_h = std::max(report.largest_h, shape.h);
    over_limit += violation(shape, parameters.refinement) > 1;
  }
  report[Counter::unrefined_facets] = over_limit;
  report.max_distance = parameters.refinement[Criterion::distance];
}

}  // namespace deliso
