// SPDX-License-Identifier: MIT
// Parts of a mesh, made and joined as the program does it, but in memory.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/parts.h"
#include "app/progress.h"
#include "base/text.h"
#include "io/parts/part_file.h"
#include "io/volume/read_volume.h"

namespace deliso::stress {

// Makes all parts, as many as the line says, and returns the bytes of their files. If `by_boxes`,
// the samples are read box by box. Throws InputError.
inline std::vector<std::string> make_parts(const CommandLine& line, bool by_boxes = false) {
  std::vector<std::string> bytes;
  for (int n = 1; n <= line.mesh.part->of; ++n) {
    CommandLine of_part = line;
    of_part.mesh.part->number = n;
    VolumeSource source = source_of(read_volume(line.input, reading_of_part(of_part)));
    if (by_boxes) source.in_memory.reset();
    bytes.push_back(part_bytes(make_part(source, of_part, line.input, nullptr)));
  }
  return bytes;
}

// A join, as the command makes it; it writes no file.
struct Joined {
  CommandLine line;
  Input input;
  MeshRun run{line, input};
  TriMesh mesh;

  Joined(CommandLine joined_line, Input joined_input)
      : line(std::move(joined_line)), input(std::move(joined_input)) {}
  Joined(const Joined&) = delete;
  Joined& operator=(const Joined&) = delete;
};

// Joins the parts, in any order, of the volume in a file. `report`: the options of the join. Throws
// InputError.
std::unique_ptr<Joined> join_parts(const std::vector<std::string>& bytes, const std::string& volume,
                                   const std::vector<std::string>& report) {
  std::vector<PartFile> parts;
  for (const std::string& part : bytes) {
    parts.push_back(part_in(std::as_bytes(std::span(part)), text("part", parts.size())));
  }
  sort_parts(parts);
  std::vector<std::string> words{"join", "v.part", "--volume=" + volume,
                                 "-o",   "v.ply",  "--threads=1"};
  words.insert(words.end(), report.begin(), report.end());
  CommandLine line = line_of_join(test::parse_words(words), parts.front());
  line.output.clear();
  const FieldSource field = field_source(source_of(read_volume(volume, line.read)), line, volume);
  require_field(parts, field, line.options, volume);
  auto joined = std::make_unique<Joined>(line, input_of_join(line, field));
  ProgressBar none(mesh_stages(line), false);
  joined->mesh = join_parts_of(std::move(parts), joined->run, none);
  return joined;
}

// Makes what the command writes of the run: the reports that its line asks for.
template <class Run>
void make_reports(const Run& run) {
  if (!run.line.json.empty()) report_json(run);
  if (!run.line.quiet) report_text(run);
}

}  // namespace deliso::stress
