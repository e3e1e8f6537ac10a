// SPDX-License-Identifier: MIT
// The solid command: a closed surface from a file in, a file of tetrahedra out; and the check
// command of such a file.
#include <optional>
#include <vector>

#include "app/closed_surface.h"
#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/solid_run.h"
#include "app/text.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "io/solid/read_solid.h"

namespace deliso {

int run_solid(const CommandLine& line) {
  const Stopwatch total;
  std::vector<std::string> outputs = solid_files(line.output, line.solid.format);
  outputs.push_back(line.json);
  require_outputs(outputs, line.meshes);
  ProgressBar progress(solid_stages(), !line.quiet);
  progress.show("reading", 0);
  MeshNotes notes;
  const TriMesh surface = read_mesh(line.meshes.front(), &notes);
  SolidRun run{line};
  run.seconds.read = total.seconds();
  make_solid_of(surface, notes, run, progress);
  if (!line.output.empty()) {
    progress.show("writing", 0);
    const Stopwatch writing;
    const DeferSignals defer;
    write_solid(run.solid, run.frame, line.output, run.write_options());
    run.cost.write = writing.seconds();
  }
  write_report(run, total, progress);
  print_report(run);
  return run.sound() ? kExitSuccess : kFaultFound;
}

int run_check_solid(const CommandLine& line) {
  require_outputs({&line.json, 1}, line.meshes);
  const SolidFile file = read_solid(line.meshes.front());
  std::vector<RegionLabel> labels;
  for (const std::int64_t label : file.labels) labels.push_back({label});
  std::optional<ClosedSurface> surface;
  if (line.meshes.size() > 1) {
    MeshNotes notes;
    const TriMesh mesh = read_mesh(line.meshes.back(), &notes);
    surface = closed_surface(mesh, notes);
  }
  const LabeledSolidCheck check = check_labeled(
      file.solid, std::move(labels), surface ? &surface->mesh : nullptr, line.options.threads);
  if (!line.json.empty()) {
    ReportWriter out("check");
    add_checked_solid(out, line.meshes, check);
    write_text(line.json, out.finish());
  }
  if (!line.quiet && line.json != "-") {
    print(text("solid     ", one_line(line.meshes.front()), "\n          ",
               counted(check.result.points, "point"), ", ", counted(check.result.cells, "cell"),
               "\n", solid_check_text(check)));
  }
  return check.result.faults.any() ? kFaultFound : kExitSuccess;
}

}  // namespace deliso
