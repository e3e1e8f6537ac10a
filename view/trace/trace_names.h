// SPDX-License-Identifier: MIT
// What the numbers of a trace's events mean, in words for its viewer.
#pragma once

#include <string_view>

#include "view/trace/trace.h"

namespace deliso {

struct RoutineName {
  std::string_view name, figure;  // of the paper; empty: it has none
  int stage;
  std::string_view text;
};
RoutineName name_of(Routine routine);
// An operation of Stage 2 as a routine, in whose numbers it follows the others.
RoutineName routine_of(Operation operation);

struct ReasonName {
  std::string_view name, text;  // of a reason, what an event's value is, too
};
ReasonName name_of(Reason reason);
ReasonName name_of(PaperReason reason);

// A refusal's name begins with "refused".
ReasonName name_of(TraceOutcome outcome);

}  // namespace deliso
