// SPDX-License-Identifier: MIT
#include "app/label_table.h"

#include <algorithm>

#include "app/solid.h"
#include "app/text.h"
#include "base/text.h"
#include "io/files/append_format.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr char kColumns[] = "%*s %11s %7s %9s %9s %12s %12s %10s %10s %6s %5s %9s %7s%s\n";

}  // namespace

void warn_of_vanished(std::string_view label, std::uint64_t samples, Diagnostics& notes) {
  add_warning(notes, "label-vanished", "", "label ", label,
              " vanished: smoothing left nothing of its ", counted(samples, "sample"),
              "; a smaller --smooth or --median keeps more")
      .with("samples", static_cast<double>(samples));
}

int label_width(std::span<const LabelSamples> labels) {
  std::size_t width = 7;
  for (const LabelSamples& l : labels) width = std::max(width, text(l.label).size());
  return static_cast<int>(width);
}

std::string label_heading(int width) {
  std::string heading;
  append_format(heading, kColumns, width, "label", "voxels", "weight", "vertices", "triangles",
                "voxel volume", "mesh volume", "difference", "components", "Euler", "loops",
                "topology", "seconds", "");
  return heading;
}

std::string text_of(const LabelRow& row, int width) {
  const std::optional<double>& volume = row.mesh_volume;
  std::string line, off;
  if (volume) append_format(off, "%.2f %%", 100 * (*volume / row.voxel_volume - 1));
  const std::string name = row.name.empty() ? "" : "  " + one_line(row.name);
  append_format(
      line, kColumns, width, text(row.label.label).c_str(), grouped(row.label.samples).c_str(),
      rounded(row.label.weight, 3).c_str(), grouped(row.vertices).c_str(),
      grouped(row.triangles).c_str(), volume_text(row.voxel_volume).c_str(),
      (volume ? volume_text(*volume) : "open").c_str(), off.c_str(),
      grouped(row.mesh.components).c_str(), text(row.mesh.euler).c_str(),
      grouped(row.mesh.boundary_loops).c_str(), row.mesh == row.exact ? "exact" : "not exact",
      fixed(row.seconds, 2).c_str(), name.c_str());
  return line;
}

}  // namespace deliso
