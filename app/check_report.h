// SPDX-License-Identifier: MIT
// A verification for people and for programs, and the options it takes from the command line.
#pragma once

#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/criteria_note.h"
#include "app/json.h"
#include "check/verify.h"

namespace deliso {

// What to do about crossings that rounding to float made.
inline constexpr const char* kKeepDoubles =
    ".ply, .off, .obj and .vtp keep doubles, without --float";

// The limits are those of the command line; of the check command those of `noted`, what the mesh's
// file says, where options do not say otherwise. Distances are required by the check command alone,
// and only where it was told one. Lengths in the scaled frame; position_error is left 0.
VerifyOptions verify_options(const CommandLine& line, const Volume& volume,
                             const std::optional<Criteria>& noted = std::nullopt);

// Aligned lines; lengths in voxels (the smallest spacing), places of faults in the world frame.
std::string verification_text(const Verification& v, const Volume& volume);

// An object "check".
void add_verification(JsonWriter& json, const Verification& v, const Volume& volume);

}  // namespace deliso
