// SPDX-License-Identifier: MIT
// Which of the conditions of surface/criteria.h a facet passes by most, for a trace.
#pragma once

#include <array>
#include <utility>

#include "surface/criteria.h"
#include "trace/trace.h"

namespace deliso {

// The one that violation() is by.
inline Reason worst_criterion(const FacetShape& s, double pole, const Criteria& k) {
  const double worst = violation(s, pole, k);
  if (!(s.r <= k.r_min)) {
    const std::array<std::pair<double, Reason>, 4> others{
        {{s.h / (s.r * k.h_over_r), Reason::h_over_r},
         {s.r / (pole * k.r_over_pole), Reason::r_over_pole},
         {s.h / k.max_distance, Reason::max_distance},
         {s.r / k.max_radius, Reason::max_radius}}};
    for (const auto& [passed, reason] : others) {
      if (passed == worst) return reason;
    }
  }
  return Reason::r_over_l;
}

}  // namespace deliso
