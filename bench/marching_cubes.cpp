// SPDX-License-Identifier: MIT
// Meshes a volume by Marching Cubes, for the figures that compare (figures/draw_figures.sh).
//   marching_cubes INPUT ISOVALUE OUT
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "support/marching_cubes.h"
#include "volume/volume.h"

using namespace deliso;

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: marching_cubes INPUT ISOVALUE OUT\n", stderr);
    return 2;
  }
  try {
    const Volume volume = read_volume(argv[1], {}, nullptr);
    const TriMesh mesh =
        marching_cubes(volume, geometric_isovalue(volume.type(), std::strtod(argv[2], nullptr)));
    write_mesh(mesh, argv[3], {.format = mesh_format_of(argv[3])});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "marching_cubes: %s\n", error.what());
    return 2;
  }
  return 0;
}
