// SPDX-License-Identifier: MIT
// A verification for people and for programs, and the options it takes from the command line.
#pragma once

#include <string>

#include "app/command_line.h"
#include "app/json.h"
#include "check/verify.h"

namespace deliso {

// r_min, distances and the rest in the scaled frame; position_error is left 0.
VerifyOptions verify_options(const CommandLine& line, const Volume& volume);

// Aligned lines; lengths in voxels (the smallest spacing), places of faults in the world frame.
std::string verification_text(const Verification& v, const Volume& volume);

// An object "check".
void add_verification(JsonWriter& json, const Verification& v, const Volume& volume);

}  // namespace deliso
