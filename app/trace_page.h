// SPDX-License-Identifier: MIT
// A trace as a page's data: its arrays by name, and the header that explains them.
#pragma once

#include <string>

#include "app/command_line.h"
#include "app/input.h"
#include "surface/report.h"
#include "view/page/page.h"
#include "view/trace/trace.h"

namespace deliso {

// A volume of more samples is left out of the page, and its slices are not shown.
inline constexpr std::size_t kMostSamplesShown = std::size_t{1} << 21;

void add_trace(const Trace& trace, PageData& data);
// Integers of 8 and 16 bits as they are, others as shares of the range, in 16 bits.
void add_samples(const Volume& volume, const ValueRange& range, PageData& data);
// What the arrays mean, what the run was, and how long it took unless times are left out.
// The axis of the scaled frame that is nearest to superior, which is +z in RAS and LPS; +z where
// the file names neither.
Up superior_of(const Frame& frame);

std::string trace_header(const CommandLine& line, const Input& input, const Report& report,
                         const Trace& trace);

}  // namespace deliso
