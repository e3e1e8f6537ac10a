// SPDX-License-Identifier: MIT
// deliso mesh --part: one part of a mesh, for deliso join.
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/output.h"
#include "app/parts.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"

namespace deliso {

int run_part(const CommandLine& line) {
  ProgressBar progress(mesh_stages(line), !line.quiet);
  progress.show("reading", 0);
  ReadLog log;
  const Volume volume = read_volume(line.input, reading_of_part(line), &log);
  std::vector<std::string> files = log.paths();
  if (line.input == "-") files.push_back(line.input);
  require_outputs(std::array{line.output}, files);
  progress.tell(line.notes);
  progress.tell(log.notes);
  PartFile part = of_unchanged(log.files, [&] {
    return make_part(source_of(volume), line, line.input, &progress, log.ids);
  });
  progress.show("writing", 0);
  const std::size_t vertices = part.block.mesh.mesh.points.size();
  const std::size_t triangles = part.block.mesh.mesh.faces.size();
  const std::string bytes = part_bytes(std::move(part));
  const DeferSignals defer;
  AtomicFile file(line.output);
  file.write(bytes);
  file.commit();
  progress.clear();
  if (!line.quiet && line.output != "-") {
    print(text("part      ", line.mesh.part->number, " of ", line.mesh.part->of, " -> ",
               one_line(line.output), "\nmesh      ") +
          counted(vertices, "vertex", "vertices") + ", " + counted(triangles, "triangle") + "\n");
  }
  return kExitSuccess;
}

}  // namespace deliso
