// SPDX-License-Identifier: MIT
// Caps and the enclosed volume in reports.
#pragma once

#include <cstddef>
#include <string>

#include "app/report_writer.h"
#include "base/frame.h"
#include "check/verify.h"

namespace deliso {

// Returns a volume of the scaled frame in world units.
double world_volume(double scaled, const Frame& frame);

// Returns "volume 12.5, caps of 7 new vertices and 31 triangles, ...", without an end of line.
std::string solid_text(const SolidSummary& solid, const Frame& frame);

// The meaning of the number of count_at_caps() in the JSON.
inline constexpr const char* kCapClosePlaces =
    "with --cap: needles, folds and near vertices that caps take part in; no faults, but programs "
    "that fill the solid may refuse it";

// Returns "3 places where caps ...".
std::string close_at_caps_text(std::size_t count);

// Returns six digits, or a whole number from 100,000 on.
std::string volume_text(double volume);

// Adds an object "solid".
void add_solid(ReportWriter& out, const SolidSummary& solid, const Frame& frame);

}  // namespace deliso
