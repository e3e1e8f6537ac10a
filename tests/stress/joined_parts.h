// SPDX-License-Identifier: MIT
// Parts of a mesh, made and joined as the program does it, but in memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
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
  for (int n = 1; n <= line.part->of; ++n) {
    CommandLine of_part = line;
    of_part.part->number = n;
    VolumeSource source = source_of(read_volume(line.input, reading_of_part(of_part)));
    if (by_boxes) source.in_memory.reset();
    bytes.push_back(part_bytes(make_part(source, of_part, line.input, nullptr)));
  }
  return bytes;
}

// Joins the parts, in any order, for the run of their command line. Throws InputError.
template <class Warn>
TriMesh join_parts(const std::vector<std::string>& bytes, MeshRun& run, Progress& progress,
                   const Warn& warn) {
  std::vector<PartFile> parts;
  for (const std::string& part : bytes) {
    parts.push_back(part_in(std::as_bytes(std::span(part)), text("part", parts.size())));
  }
  sort_parts(parts);
  const std::string& input = run.line.input;
  const CommandLine noted = line_of(parts.front(), input);
  const FieldSource field = field_source(source_of(read_volume(input, noted.read)), noted, input);
  require_field(parts, field, noted.options, input);
  return join_parts_of(field, std::move(parts), run, progress, warn);
}

}  // namespace deliso::stress
