// SPDX-License-Identifier: MIT
// The numbers that a trace's events have for what the stages name: rungs follow the routines,
// criteria the reasons, refusals the outcomes.
#pragma once

#include "surface/criteria.h"
#include "surface/report.h"
#include "trace/trace.h"

namespace deliso {

constexpr std::uint8_t trace_code(Rung rung) {
  return static_cast<std::uint8_t>(trace_code(Routine::count_) + static_cast<unsigned>(rung));
}
constexpr std::uint8_t trace_code(Criterion criterion) {
  return static_cast<std::uint8_t>(trace_code(Reason::count_) + static_cast<unsigned>(criterion));
}
constexpr std::uint8_t trace_code(Refusal refusal) {
  return static_cast<std::uint8_t>(trace_code(TraceOutcome::count_) +
                                   static_cast<unsigned>(refusal));
}

}  // namespace deliso
