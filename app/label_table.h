// SPDX-License-Identifier: MIT
// The table of --label all: a line for each label.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "base/topology_counts.h"
#include "io/filter/segmentation.h"

namespace deliso {

struct LabelRow {
  LabelSamples label;
  std::string name;                   // of its segment, or empty
  double voxel_volume = 0;            // world units
  std::optional<double> mesh_volume;  // enclosed; none of an open mesh
  std::size_t vertices = 0, triangles = 0;
  TopologyCounts mesh, exact;
  double seconds = 0;
};

// Warns of a label whose field is the largest at no sample.
void warn_of_vanished(std::string_view label, std::uint64_t samples, Diagnostics& notes);

// Returns the characters of the table's first column.
int label_width(std::span<const LabelSamples> labels);
std::string label_heading(int width);
std::string text_of(const LabelRow& row, int width);

}  // namespace deliso
