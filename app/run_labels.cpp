// SPDX-License-Identifier: MIT
// deliso mesh --label all: a mesh for each label of a segmentation, and a table of them.
#include <cstdio>
#include <string>
#include <vector>

#include "app/mesh_run.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "io/files/append_format.h"

namespace deliso {
namespace {

constexpr std::size_t kMostLabels = 1000;  // more are hardly a segmentation

// Returns the name with the label in place of %d.
std::string name_with(std::string name, std::int64_t label) {
  const std::size_t place = name.find("%d");
  if (place != std::string::npos) name.replace(place, 2, text(label));
  return name;
}

// Returns the command line of each label's mesh. Throws InputError if some output cannot be
// written.
std::vector<CommandLine> lines_of(const CommandLine& line, const Source& source) {
  std::vector<CommandLine> lines;
  std::vector<std::string> files = source.log.files;
  for (const LabelSamples& found : source.labels) {
    if (found.label == 0) continue;
    CommandLine one = line;
    one.field.all_labels = false;
    one.field.labels = {found.label};
    one.output = name_with(line.output, found.label);
    one.json = name_with(line.json, found.label);
    one.allow_empty = true;  // a label may fill the volume
    require_outputs(std::vector{one.output, one.json}, files);
    lines.push_back(std::move(one));
  }
  if (lines.empty()) throw InputError(line.input + ": has no label but 0");
  if (lines.size() > kMostLabels) {
    throw InputError(text(line.input, ": has ", lines.size(), " labels, more than ", kMostLabels,
                          ": --label L,L names the ones to mesh"));
  }
  return lines;
}

std::string row_of(const MeshRun& run) {
  const LabelFacts& label = *run.input.field.label;
  const std::string volume = run.has_volume() ? volume_text(run.volume) : "open";
  std::string row, off;
  if (run.has_volume()) append_format(off, "%.2f %%", 100 * run.volume_difference());
  append_format(row, "%10s %11s %8s %10s %12s %12s %10s %10s %9s %8.2f\n",
                text(label.labels.front()).c_str(), grouped(label.samples).c_str(),
                rounded(label.weight, 3).c_str(), grouped(run.vertices).c_str(),
                volume_text(label.volume).c_str(), volume.c_str(), off.c_str(),
                grouped(run.mesh.components).c_str(),
                run.mesh == run.report.exact ? "exact" : "not exact", run.seconds_total);
  return row;
}

}  // namespace

int run_labels(const CommandLine& line) {
  ProgressBar reading(mesh_stages(line), !line.quiet);
  reading.show("reading", 0);
  Source source = read_source(line);
  reading.clear();
  print_warning(source.warning, line);
  const std::vector<CommandLine> lines = lines_of(line, source);
  source.labels =
      weighed_labels(source.volume, line.field, source.labels, line.input, line.options.threads);
  std::string table;
  append_format(table, "%10s %11s %8s %10s %12s %12s %10s %10s %9s %8s\n", "label", "voxels",
                "weight", "vertices", "voxel volume", "mesh volume", "difference", "components",
                "topology", "seconds");
  bool all_sound = true;
  for (const CommandLine& one : lines) {
    const Stopwatch total;
    ProgressBar progress(mesh_stages(one), !one.quiet);
    const Input input = input_of(source, one);
    MeshRun run(one, input);
    mesh_to_files(total, progress, run);
    all_sound &= run.sound();
    if (line.verbose && !line.quiet) print(report_text(run) + "\n");
    table += row_of(run);
  }
  if (!line.quiet) print(table);
  return all_sound ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
