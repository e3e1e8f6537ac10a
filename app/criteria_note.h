// SPDX-License-Identifier: MIT
// The criteria of a mesh, as one line in its file, so that a check can use the same criteria.
// Lengths are in voxels, so the line does not depend on the file's frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/command_line.h"
#include "run/criteria.h"
#include "volume/volume.h"

namespace deliso {

// Returns `deliso 0.1.0 r-min=0.5 max-distance=0.1 lambda=2` or the like, with all finite limits of
// run/criteria.h. Lengths in voxels.
std::string criteria_note(const Criteria& criteria);

// Returns the criteria of the first such line in a file's comments; nullopt if there is none. A
// line is ignored if a number is bad or out of range, or r-min or lambda is missing. Words with
// unknown names are skipped.
std::optional<Criteria> noted_criteria(std::span<const std::string> comments);

// Returns the line for the mesh of a run. With --vertices it has no distance, since none was asked
// for. For a mesh without criteria (Marching Cubes, Stage 1 alone) it names the method, and a check
// ignores it. The words of the field follow (app/field.h).
std::string criteria_note(const CommandLine& line, const Grid& volume);

}  // namespace deliso
