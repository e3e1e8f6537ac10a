// SPDX-License-Identifier: MIT
// Advice: what the samples or the mesh of a run say about its options. One line, or an empty text.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "app/input.h"
#include "app/mesh_run.h"

namespace deliso {

// A mask of two values, such as 0 and 255, is meshed by an isovalue near one of them: the surface
// is one of steps, with its vertices near samples.
std::string mask_advice(const Input& input);

// Whole samples of floats equal the isovalue, and the mesh has thin triangles where they do: the
// surface passes next to them. Half a step lower the same samples are inside. Looks at samples in
// memory only, so that a join reads no others for an advice.
std::string tie_advice(const MeshRun& run);

// The mesh of labels is open where they reach the volume's border.
std::string border_advice(std::span<const std::int64_t> labels);

}  // namespace deliso
