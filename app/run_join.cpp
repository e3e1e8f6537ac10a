// SPDX-License-Identifier: MIT
// The join command: the meshes of a volume's blocks in, the whole out.
#include <array>

#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "base/check.h"
#include "io/parts/join.h"

namespace deliso {

int run_join(const CommandLine& line) {
  require_outputs(std::array{line.output}, line.meshes);
  const DeferSignals defer;
  const Joined joined =
      join_parts(line.meshes, line.output, line.write.single_precision, line.write.ascii);
  if (!line.quiet && line.output != "-") {
    print("joined    " + counted(joined.parts, "part", "parts") + " to " + one_line(line.output) +
          "\nmesh      " + counted(joined.vertices, "vertex", "vertices") + ", " +
          counted(joined.triangles, "triangle", "triangles") + "\nseams     " +
          counted(joined.seam_vertices, "vertex", "vertices") + ", " +
          counted(joined.seam_edges, "edge", "edges") + "\n");
  }
  return kExitSuccess;
}

}  // namespace deliso
