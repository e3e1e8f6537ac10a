// SPDX-License-Identifier: MIT
// A verification as text and as JSON, and its options from the command line.
#pragma once

#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/criteria_note.h"
#include "app/json.h"
#include "check/verify.h"

namespace deliso {

// Advice about crossings that rounding to float made.
inline constexpr const char* kKeepDoubles =
    ".ply, .off, .obj, .vtp, .3mf, .smesh and .poly keep doubles, without --float";

// Returns the options of a verification, with lengths in the scaled frame and position_error 0. The
// limits come from the command line; the check command prefers `noted`, the criteria in the mesh's
// file, to defaults. Only the check command requires distances, and only if one was given.
VerifyOptions verify_options(const CommandLine& line, const Volume& volume,
                             const std::optional<Criteria>& noted = std::nullopt);

// Returns aligned lines. Lengths are in voxels (the smallest spacing), places of faults in the
// world.
std::string verification_text(const Verification& v, const Volume& volume);

// Adds an object "check".
void add_verification(JsonWriter& json, const Verification& v, const Volume& volume);

}  // namespace deliso
