// SPDX-License-Identifier: MIT
// deliso mesh --label all: a mesh for each label of a segmentation, and a table of them.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/advice.h"
#include "app/label_table.h"
#include "app/mesh_run.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/signals.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "view/render/color_map.h"

namespace deliso {
namespace {

constexpr std::size_t kMostLabels = 1000;  // more are hardly a segmentation

}  // namespace

std::string name_with(std::string name, std::string_view what) {
  const std::size_t place = name.find("%d");
  if (place != std::string::npos) name.replace(place, 2, what);
  return name;
}

std::vector<CommandLine> lines_of_labels(const CommandLine& line, const Source& source) {
  std::vector<CommandLine> lines;
  const std::vector<std::string> files = source.log.paths();
  const bool shared = !line.mesh.shared.empty();
  for (const LabelSamples& found : source.labels) {
    if (found.label == 0) continue;
    CommandLine one = line;
    one.field.all_labels = false;
    one.field.labels = {found.label};
    one.output = name_with(line.output, text(found.label));
    one.json = shared ? "" : name_with(line.json, text(found.label));
    one.mesh.allow_empty = true;  // a label may fill the volume
    for (const NamedSegment& segment : source.log.segments) {
      if (segment.label != found.label) continue;
      one.mesh.write.name = segment.name;
      const bool is_object = in_one_file(line) || line.output.empty();  // or may become one
      if (segment.color && is_object)
        one.mesh.write.label = ObjectLabel{found.label, *segment.color};
    }
    require_outputs(std::array{line.mesh.shared, shared ? line.json : "", one.output, one.json},
                    files);
    lines.push_back(std::move(one));
  }
  if (lines.empty()) throw InputError(line.input, ": has no label but 0");
  if (lines.size() > kMostLabels) {
    throw InputError(line.input, ": has ", lines.size(), " labels, more than ", kMostLabels,
                     ": --label L,L names the ones to mesh");
  }
  return lines;
}

void write_labels(std::vector<MeshObject> objects, std::span<const std::int64_t> labels,
                  const std::string& path) {
  for (std::size_t n = 0; n < objects.size(); ++n) {
    MeshWriteOptions& options = objects[n].options;
    if (options.name.empty()) options.name = text("label ", labels[n]);
    const Rgb own = category_color(static_cast<std::size_t>(labels[n]));
    const std::array color{own.red, own.green, own.blue};
    options.label = {labels[n], options.label ? options.label->color : color};
  }
  // The file's comment: it has all labels.
  std::string& comment = objects.front().options.comment;
  constexpr std::string_view kLabel = " label=";
  const std::size_t begin = comment.find(kLabel);
  if (begin != comment.npos) {
    const std::size_t value = begin + kLabel.size();
    comment.replace(value, std::min(comment.find(' ', value), comment.size()) - value, "all");
  }
  const DeferSignals defer;
  write_objects(objects, path);
}

int run_labels(const CommandLine& line) {
  const Stopwatch all;
  ProgressBar progress(mesh_stages(line), !line.quiet);
  progress.show("reading", 0);
  Source source = read_source(line);
  progress.tell(source.log.notes);
  const std::vector<CommandLine> lines = lines_of_labels(line, source);
  if (!line.mesh.shared.empty()) return run_shared(all, source, line, lines, progress);
  source.labels = label_fields({source.volume, source.log.ids}, line.field, source.labels,
                               line.input, line.options.threads)
                      .weighed();
  const int width = label_width(source.labels);
  std::string table = label_heading(width);
  bool all_sound = true;
  std::vector<MeshObject> objects;
  std::vector<std::int64_t> labels, open;
  for (const CommandLine& one : lines) {
    const Stopwatch total;
    progress.restart(mesh_stages(one));
    const Input input = input_of(source, one);
    MeshRun run(one, input);
    run.is_one_of_all = true;
    const TriMesh mesh = mesh_input(run, progress);
    write_files(total, progress, run, mesh, in_one_file(line) ? &objects : nullptr);
    labels.push_back(one.field.labels.front());
    if (run.is_open_label()) open.push_back(labels.back());
    all_sound &= run.sound();
    if (line.mesh.verbose && !line.quiet) print(report_text(run) + "\n");
    const LabelFacts& label = *input.field.label;
    const auto found = std::ranges::find(source.labels, label.labels.front(), &LabelSamples::label);
    table +=
        text_of({*found, one.mesh.write.name, label.volume,
                 run.has_volume() ? std::optional(run.volume()) : std::nullopt, run.found.vertices,
                 run.found.triangles, run.found.topology, run.report.exact, run.cost.total},
                width);
  }
  if (!objects.empty()) write_labels(std::move(objects), labels, line.output);
  Diagnostics notes;
  advise_of_border(open, notes);
  progress.tell(notes);
  if (!line.quiet) print_report(table, line.output == "-");
  return all_sound ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
