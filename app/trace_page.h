// SPDX-License-Identifier: MIT
// A trace as data of a page: arrays by name, and a header that explains them.
#pragma once

#include <string>

#include "app/command_line.h"
#include "app/input.h"
#include "base/topology_counts.h"
#include "run/report.h"
#include "view/page/page.h"
#include "view/trace/trace.h"

namespace deliso {

// A volume of more samples is left out of the page, and its slices are not shown.
inline constexpr std::size_t kMostSamplesShown = std::size_t{1} << 21;

void add_trace(const Trace& trace, PageData& data);
// Adds the samples: integers of 8 and 16 bits unchanged, others as shares of the range in 16 bits.
void add_samples(const Volume& volume, const ValueRange& range, PageData& data);
// Returns the axis of the scaled frame that is nearest to superior, which is +z in RAS and LPS; +z
// if the file names neither.
Up superior_of(const Frame& frame);

// Returns the header: the meaning of the arrays, the run, the topology of its mesh, and its times
// unless they are left out.
std::string trace_header(const CommandLine& line, const Input& input, const Report& report,
                         const TopologyCounts& mesh, const Trace& trace);

}  // namespace deliso
