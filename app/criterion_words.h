// SPDX-License-Identifier: MIT
// The words for the criteria of run/criteria.h in options, help texts, reports and traces. A
// new row there needs one here.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "run/criteria.h"

namespace deliso {

struct CriterionWords {
  std::string_view option;    // two hyphens and the criterion's name
  std::string_view measured;  // the measure, in reports
  std::string_view key;       // in the JSON of a check
  std::string_view argument, help;
  std::string_view check_help;  // empty: a check cannot measure it
};

inline constexpr std::array<CriterionWords, kCriteria> kCriterionWords{{
    {"--max-distance", "h", "distance", "D|Dvox",
     "no triangle further than D from the surface at its circumcenter, and no point of the surface "
     "further than 2 D from the mesh, as far as --rmin allows: world units, or voxels (default "
     "0.1vox)",
     "exit 1 unless the mesh keeps to D and the surface to 2 D (default: what the mesh's file "
     "says, and no exit 1 for it): world units, or voxels"},
    {"--lambda", "r/l", "lambda", "X",
     "largest r over shortest edge, also below --rmin down to 0.05vox (default 2: no angle below "
     "14.4 degrees)",
     "r over shortest edge that is counted as too large (default: what the mesh's file says, or "
     "2)"},
    {"--eps1", "h/r", "h_over_r", "X",
     "largest h/r, the paper's 0.1 (default: none); turns --max-distance off unless that is given",
     "h/r that is counted as too large (default: what the mesh's file says, or none)"},
    {"--max-radius", "r", "radius", "R|Rvox", "largest r: world units, or voxels (default: none)",
     "r that is counted as too large (default: what the mesh's file says, or none)"},
}};
// All of them, in the order of Criterion.
static_assert(std::ranges::equal(
    kCriterionWords, kCriterionTable, {},
    [](const CriterionWords& words) { return words.option.substr(2); }, &CriterionRow::name));

}  // namespace deliso
