// SPDX-License-Identifier: MIT
// deliso join: all parts of a mesh and their volume in, the mesh out, as deliso mesh writes it.
#include <algorithm>
#include <string>
#include <vector>

#include "app/field.h"
#include "app/mesh_run.h"
#include "app/output.h"
#include "app/parts.h"
#include "app/progress.h"
#include "app/run.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"
#include "mesh_parts.h"

namespace deliso {
namespace {

// The line that the parts were made with, but for what join decides.
CommandLine line_of_mesh(const CommandLine& join, const PartFile& part, const std::string& name) {
  CommandLine line = line_of(part, name, join.input);
  line.output = join.output;
  line.write = join.write;
  line.json = join.json;
  line.attributes = join.attributes;
  line.check = join.check;
  line.quiet = join.quiet;
  line.verbose = join.verbose;
  line.options.threads = join.options.threads;
  return line;
}

// Returns the field for the report and a check: in memory where samples are asked.
Field field_of(const Volume& volume, const FieldSource& field, const CommandLine& line) {
  if (!line.field.any()) return {volume};
  if (!line.check && !line.attributes && !line.options.cap) return {field.source.shape};
  return {all_of(field.source)};
}

}  // namespace

int run_join(const CommandLine& join) {
  const Stopwatch total;
  std::vector<PartFile> parts;
  std::vector<std::string> names = join.meshes, files = names;
  for (const std::string& name : names) {
    const Bytes bytes = name == "-" ? read_standard_input() : open_file(name);
    parts.push_back(part_in(bytes.data, bytes.name));
  }
  sort_parts(parts, names);
  const CommandLine line = line_of_mesh(join, parts.front(), names.front());
  ReadLog log;
  const Stopwatch reading;
  const Volume volume = read_volume(line.input, line.read, &log);
  files.insert(files.end(), log.files.begin(), log.files.end());
  require_outputs(std::vector{line.output, line.json}, files);
  const FieldSource field = field_source(source_of(volume), line, line.input);
  require_field(parts, names, field, line.options, line.input);

  ProgressBar progress(mesh_stages(line), !line.quiet);
  const Input input{
      line.input, field_of(volume, field, line), {}, log, reading.seconds(), field.isovalue, ""};
  MeshRun run(line, input);
  Options options = line.options;
  options.observer = &progress;
  std::vector<Block> blocks;
  for (PartFile& part : parts) blocks.push_back(std::move(part.block));
  const TriMesh mesh =
      mesh_of_parts(field.source, field.isovalue, options, std::move(blocks), run.report);
  if (mesh.faces.empty() && !join.allow_empty) {
    throw InputError("the mesh of the parts is empty (--allow-empty accepts that)");
  }
  examine_mesh(run, mesh, progress, warner(progress, line));
  write_files(total, progress, run, mesh);
  print_report(run);
  return run.sound() ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
