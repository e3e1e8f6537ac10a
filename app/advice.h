// SPDX-License-Identifier: MIT
// Advice: what the samples or the mesh of a run say about its options. Each adds a warning, or
// none, to the list of the run.
#pragma once

#include <cstdint>
#include <span>

#include "app/input.h"
#include "app/mesh_run.h"

namespace deliso {

// A mask of two values, such as 0 and 255, is meshed by an isovalue near one of them: the surface
// is one of steps, with its vertices near samples.
void advise_of_mask(const Input& input, Diagnostics& notes);

// Whole samples of floats equal the isovalue, and the mesh has thin triangles where they do: the
// surface passes next to them. Half a step lower the same samples are inside. Looks at samples in
// memory only, so that a join reads no others for an advice.
void advise_of_ties(MeshRun& run);

// The mesh of labels is open where they reach the volume's border.
void advise_of_border(std::span<const std::int64_t> labels, Diagnostics& notes);

}  // namespace deliso
