// SPDX-License-Identifier: MIT
// What --color-by makes of the meshes of a picture.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/command_line.h"
#include "view/render/color_bar.h"

namespace deliso {

struct FacetColors {
  std::vector<std::vector<Rgb>> of_mesh;  // one for each; of no facets where sides have the colors
  std::optional<ColorBar> bar;            // one scale for all meshes
  std::vector<std::size_t> components;    // of each mesh; empty but for ColorBy::component
};

// Reads the volume where the colors need one. Throws as read_input, and InputError where no facet
// is near the isosurface.
FacetColors color_facets(std::span<const TriMesh> meshes, const CommandLine& line);

}  // namespace deliso
