// SPDX-License-Identifier: MIT
// The criteria that a mesh was made by, as one line that goes with the mesh in its file, so that a
// check can judge it by the same. Lengths are in voxels (of the shortest side of one): the line
// does not depend on the frame that the file is in.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/command_line.h"
#include "surface/criteria.h"
#include "surface/report.h"
#include "volume/volume.h"

namespace deliso {

// `deliso 0.1.0 r-min=0.5 max-distance=0.1 lambda=2`, and others of surface/criteria.h; infinite
// ones are left out. Lengths in voxels.
std::string criteria_note(const Criteria& criteria);

// What the first such line among a file's comments says. A line of anything else, with a number
// that is none or out of range, or without r-min or lambda, is no such line; words of names that
// are not known are passed over.
std::optional<Criteria> noted_criteria(std::span<const std::string> comments);

// The line for the mesh of a run: with --vertices the distance that was reached. Where the mesh was
// made by no criteria (Marching Cubes, Stage 1 alone) it says that, and nothing for a check.
std::string criteria_note(const CommandLine& line, const Volume& volume, const Report& report);

}  // namespace deliso
