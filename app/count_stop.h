// SPDX-License-Identifier: MIT
// Whether a mesh has the number of vertices or triangles that --vertices or --triangles asked for,
// and what stopped it otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/mesh_run.h"
#include "base/topology_counts.h"
#include "run/options.h"

namespace deliso {

enum class CountStop : std::uint8_t {
  none,        // at most the number asked for, and at most 2 %, or one, below it
  topology,    // more: no removal was left that keeps the topology and lets no triangles cross
  clear_box,   // more: the number was reached, and --cap added vertices to clear the box
  refinement,  // fewer: triangles so small, or so near to the surface, are not refined
};

// A mesh, of which a number may have been asked for; caps do not count.
struct CountedMesh {
  const Options& options;
  std::size_t vertices = 0, triangles = 0;
  std::size_t vertices_refined = 0, triangles_refined = 0;  // when Stage 2 ended
  TopologyCounts topology;
};
// pre: the run's mesh is made; for count_text() its topology is known.
CountedMesh counted_mesh(const MeshRun& run);

// Returns what stopped the number.
CountStop count_stop(const CountedMesh& mesh);
inline CountStop count_stop(const MeshRun& run) {
  return count_stop(counted_mesh(run));
}

std::string_view name_of(CountStop stop);

// Warns of a number that is not met.
void warn_of_count(const CountedMesh& mesh, Diagnostics& notes);

// Returns the number and what stopped it, in one line; empty if nothing did.
std::string count_text(const CountedMesh& mesh);
inline std::string count_text(const MeshRun& run) {
  return count_text(counted_mesh(run));
}

}  // namespace deliso
