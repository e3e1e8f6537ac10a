// SPDX-License-Identifier: MIT
// The colors of --color-by for the meshes of a picture.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/command_line.h"
#include "app/input.h"
#include "io/mesh/read_mesh.h"
#include "view/render/color_bar.h"

namespace deliso {

struct FacetColors {
  std::vector<std::vector<Rgb>> of_mesh;  // per mesh and facet; empty if sides have the colors
  std::optional<ColorBar> bar;            // one scale for all meshes
  std::vector<std::size_t> components;    // per mesh; only with ColorBy::component
};

// Returns the colors. `input`: the volume, if the command line has one. `notes`: of each mesh's
// file. Throws InputError if no facet is near the isosurface, or a file has no colors or labels.
FacetColors color_facets(std::span<const TriMesh> meshes, std::span<const MeshNotes> notes,
                         const CommandLine& line, const Input* input);

}  // namespace deliso
