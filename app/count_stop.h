// SPDX-License-Identifier: MIT
// Whether a mesh has the number of vertices or triangles that --vertices or --triangles asked for,
// and what stopped it otherwise.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/mesh_run.h"

namespace deliso {

enum class CountStop : std::uint8_t {
  none,        // at most the number asked for, and at most 2 %, or one, below it
  topology,    // more: no removal was left that keeps the topology and lets no triangles cross
  clear_box,   // more: the number was reached, and --cap added vertices to clear the box
  refinement,  // fewer: triangles so small, or so near to the surface, are not refined
};

// Returns what stopped the number of the run's mesh; caps do not count. pre: the mesh is made.
CountStop count_stop(const MeshRun& run);

std::string_view name_of(CountStop stop);

// Returns the number and what stopped it, in one line; empty if nothing did. pre: the topology of
// the run's mesh is known.
std::string count_text(const MeshRun& run);

}  // namespace deliso
