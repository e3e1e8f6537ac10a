// SPDX-License-Identifier: MIT
// Runs as tables: medians and ranges over the turns, and one build beside another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/quality.h"
#include "support/table.h"

namespace deliso {

// How one build's values stand to another's: better or worse where the ranges do not overlap.
enum class Verdict : std::uint8_t { alike, better, worse };

// NaNs are left out; alike where nothing is left of either.
Verdict compare(const std::vector<double>& ours, const std::vector<double>& theirs, Better better);

// Two tables, one row for each volume, options and build, in the order in which they come; volumes
// that the first build has no runs of are left out. With a second build, what differs beyond the
// ranges is marked in the first one's row, and a third table counts that over the volumes. Builds
// beyond the second are left out.
std::vector<Table> quality_tables(const std::vector<QualityRun>& runs);

// What mechanisms are worth. The first build is the base; each other one lacks a mechanism, or has
// another constant. A row for each: the sums or medians over the volumes, marked with the numbers
// of volumes on which it is better (+) and worse (!) than the base. A mechanism pays by a measure
// that is worse without it on three volumes at least.
Table switch_table(const std::vector<QualityRun>& runs);

}  // namespace deliso
