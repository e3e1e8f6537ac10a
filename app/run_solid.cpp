// SPDX-License-Identifier: MIT
// The solid command: a closed surface from a file in, a file of tetrahedra out.
#include "app/output.h"
#include "app/peak_memory.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/solid_run.h"
#include "base/stopwatch.h"
#include "io/solid/write_solid.h"

namespace deliso {

int run_solid(const CommandLine& line) {
  const Stopwatch total;
  require_outputs(std::vector{line.output, line.json}, line.meshes);
  ProgressBar progress(solid_stages(), !line.quiet);
  progress.show("reading", 0);
  MeshNotes notes;
  TriMesh surface = read_mesh(line.meshes.front(), &notes);
  SolidRun run{line};
  run.seconds.read = total.seconds();
  make_solid_of(std::move(surface), notes, run, progress);
  if (!line.output.empty()) {
    progress.show("writing", 0);
    const Stopwatch watch;
    const DeferSignals defer;
    write_solid(run.solid, run.frame, line.output, run.write_options());
    run.cost.write = watch.seconds();
  }
  progress.clear();
  run.cost.peak_bytes = peak_memory_bytes();
  run.cost.total = total.seconds();
  if (!line.json.empty()) write_text(line.json, report_json(run));
  if (!line.quiet) print_report(report_text(run), line.output == "-" || line.json == "-");
  return kExitSuccess;
}

}  // namespace deliso
