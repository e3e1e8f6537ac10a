// SPDX-License-Identifier: MIT
// deliso mesh --label all --shared FILE: the files of labels that share their interfaces.
#include <span>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/shared_labels.h"
#include "app/signals.h"
#include "base/stopwatch.h"

namespace deliso {
namespace {

// Writes the mesh of each label into its own file, or all into one, if the line has an output.
void write_label_meshes(const SharedRun& run, std::span<const CommandLine> lines) {
  if (run.line.output.empty()) return;
  const MeshWriteOptions united = united_options(run);
  std::vector<MeshObject> objects;
  std::vector<std::int64_t> labels;
  auto one = lines.begin();
  for (BodyId body = 0; body < run.labels.size(); ++body) {
    const std::int64_t label = run.labels[body].label.label;
    if (label == 0) continue;
    TriMesh mesh = run.mesh.mesh_of(body);
    mesh.frame = run.input.grid().frame();
    MeshWriteOptions write = options_of_label(united, label);
    write.format = one->mesh.write.format;
    write.name = one->mesh.write.name;
    write.label = one->mesh.write.label;
    if (in_one_file(run.line)) {
      objects.push_back({std::move(mesh), write});
      labels.push_back(label);
    } else {
      const DeferSignals defer;
      write_mesh(mesh, one->output, write);
    }
    ++one;
  }
  if (!objects.empty()) write_labels(std::move(objects), labels, run.line.output);
}

}  // namespace

int run_shared(const Stopwatch& total, const Source& source, const CommandLine& line,
               std::span<const CommandLine> lines, ProgressBar& progress) {
  SharedRun run(line, source);
  make_shared_mesh(run, progress);
  progress.show("writing", 0);
  const Stopwatch watch;
  write_label_meshes(run, lines);
  {
    const DeferSignals defer;
    write_mesh(united_mesh(run), line.mesh.shared, united_options(run));
  }
  run.cost.write = watch.seconds();
  write_report(run, total, progress);
  print_report(run);
  return run.sound() ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
