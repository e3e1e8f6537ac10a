// SPDX-License-Identifier: MIT
// deliso join: all parts of a mesh and their volume in, the mesh out, as deliso mesh writes it.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
#include "app/output.h"
#include "app/parts.h"
#include "app/progress.h"
#include "app/run.h"
#include "base/stopwatch.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"

namespace deliso {

int run_join(const CommandLine& join) {
  const Stopwatch total;
  std::vector<PartFile> parts;
  std::vector<std::string> files = join.meshes;
  for (const std::string& name : join.meshes) {
    const Bytes bytes = name == "-" ? read_standard_input() : open_file(name);
    parts.push_back(part_in(bytes.data, bytes.name));
  }
  sort_parts(parts);
  const CommandLine line = line_of_join(join, parts.front());
  ReadLog log;
  const Stopwatch reading;
  ReadOptions read = line.read;
  read.as_labels = may_be_labels(line);
  const Volume volume = read_volume(line.input, read, &log);
  std::ranges::copy(log.paths(), std::back_inserter(files));
  require_outputs(std::vector{line.output, line.json}, files);
  const FieldSource field = field_source(source_of(volume), line, line.input, log.ids);
  require_field(parts, field, line.options, line.input);

  ProgressBar progress(mesh_stages(line), !line.quiet);
  const Input input = input_of_join(line, field, log, reading.seconds());
  MeshRun run(line, input);
  progress.tell(run.notes);
  const TriMesh mesh = join_parts_of(std::move(parts), run, progress);
  write_files(total, progress, run, mesh);
  print_report(run);
  return run.sound() ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
