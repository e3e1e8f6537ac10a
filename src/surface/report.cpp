// SPDX-License-Identifier: MIT
#include "surface/report.h"

namespace deliso {

std::string_view name_of(Counter counter) {
  constexpr std::string_view names[] = {
      "seeds_skipped",       "components_skipped", "boundary_splits_recover", "cancelled_pairs",
      "bogus_hits",          "capped_insertions",  "refused_splits",          "unresolved_facets",
      "unresolved_vertices", "facets_closed",      "components_put_back",     "voxels_cut",
      "uncertified_sites",   "unready_facets",     "crossings_handed_over",   "unrefined_facets",
      "points_far",          "cap_edges_lifted",   "cap_lifts_off_surface",   "cap_not_lifted",
      "cap_edges_split",     "cap_refused"};
  static_assert(sizeof(names) / sizeof(names[0]) == kCounterCount);
  return names[static_cast<std::size_t>(counter)];
}

std::string_view name_of(Rung rung) {
  constexpr std::string_view names[] = {"surface_point", "foot",     "boundary_split", "flip",
                                        "patch",         "collapse", "move",           "far_point"};
  static_assert(sizeof(names) / sizeof(names[0]) == kRungs);
  return names[static_cast<std::size_t>(rung)];
}

std::string_view name_of(Refusal refusal) {
  constexpr std::string_view names[] = {"not_a_disk", "no_surface_point", "too_close",
                                        "boundary",   "turned",           "no_gain",
                                        "crossing",   "beyond_part"};
  static_assert(sizeof(names) / sizeof(names[0]) == kRefusals);
  return names[static_cast<std::size_t>(refusal)];
}

void Report::add_refinement(const Report& part) {
  searches_refine += part.searches_refine;
  insertions_refine += part.insertions_refine;
  for (std::size_t r = 0; r < kRungs; ++r) {
    rungs[r].done += part.rungs[r].done;
    for (std::size_t k = 0; k < kRefusals; ++k) rungs[r].refused[k] += part.rungs[r].refused[k];
  }
}

}  // namespace deliso
