// SPDX-License-Identifier: MIT
// deliso mesh --label all --shared FILE: labels with common vertices.
#pragma once

#include <span>
#include <string>

#include "app/command_line.h"
#include "app/input.h"

namespace deliso {

// What the table of --label all says of a label's mesh.
struct LabelRow {
  const LabelSamples& label;
  double voxel_volume = 0, mesh_volume = 0;  // mesh_volume is 0 of an open mesh
  std::size_t vertices = 0;
  std::uint64_t components = 0;
  bool exact = false;
  double seconds = 0;
};
std::string label_heading();
std::string text_of(const LabelRow& row);

// Meshes the interfaces of all labels, and writes them into the line's `shared`. `lines` are those
// of the labels, whose meshes are written too if they have an output. Returns the exit status.
int mesh_shared(const CommandLine& line, const Source& source, std::span<const CommandLine> lines);

}  // namespace deliso
