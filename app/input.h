// SPDX-License-Identifier: MIT
// The volume a command works on, with what both commands report about it.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/json.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

struct Input {
  std::string name;  // as the user gave it
  Volume volume;
  ValueRange range;
  ReadLog log;
  double seconds = 0;  // reading, and looking at every sample once
};

// Reads the command's input. Throws InputError, also for the first NaN or infinite sample, and
// where an output of the run cannot be written, or is one of the files that are read: of the
// volume, and `others`.
Input read_input(const CommandLine& line, std::vector<std::string> others = {});

// Why there is no surface there: what the samples are.
std::string no_surface_text(double isovalue, const ValueRange& range);

// Aligned lines for people, and an object "volume".
std::string input_text(const Input& input);
void add_input(JsonWriter& json, const Input& input);

}  // namespace deliso
