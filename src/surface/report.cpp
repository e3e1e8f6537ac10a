// SPDX-License-Identifier: MIT
#include "surface/report.h"

namespace deliso {

std::string_view name_of(Counter counter) {
  constexpr std::string_view names[] = {
      "seeds_skipped",          "components_skipped",  "boundary_splits_recover",
      "cancelled_pairs",        "bogus_hits",          "capped_insertions",
      "unresolved_facets",      "unresolved_vertices", "facets_closed",
      "components_put_back",    "uncertified_sites",   "unready_facets",
      "needles_collapsed",      "refused_not_a_disk",  "refused_no_surface_point",
      "refused_too_close",      "refused_boundary",    "refused_crossing",
      "boundary_splits_refine", "unrefined_facets",    "cap_edges_lifted",
      "cap_lifts_off_surface",  "cap_edges_split",     "cap_refused"};
  static_assert(sizeof(names) / sizeof(names[0]) == kCounterCount);
  return names[static_cast<std::size_t>(counter)];
}

}  // namespace deliso
