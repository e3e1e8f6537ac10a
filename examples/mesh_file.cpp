// SPDX-License-Identifier: MIT
// A volume in, a mesh out, and a second opinion of it: has it the surface's topology, how good are
// its triangles, how far is it from the surface?
// Usage: mesh_file VOLUME ISOVALUE MESH
#include <cstdlib>
#include <iostream>

#include "deliso/base/check.h"
#include "deliso/check/verify.h"
#include "deliso/io/mesh/write_mesh.h"
#include "deliso/io/volume/read_volume.h"
#include "deliso/mesh_isosurface.h"

namespace {

int mesh_file(const char* input, double isovalue, const char* output) {
  const deliso::Volume volume = deliso::read_volume(input);
  const deliso::ValueRange range = deliso::value_range(volume);  // throws for a NaN
  std::cout << "samples from " << range.min << " to " << range.max << "\n";

  // Coarser than the default, a tenth of a voxel; all else stays as it is.
  deliso::Options options;
  options.limits[deliso::Criterion::distance] = {0.25, deliso::Length::Unit::voxel};
  deliso::Report report;
  const deliso::TriMesh mesh = deliso::mesh_isosurface(volume, isovalue, options, report);
  std::cout << mesh.points.size() << " vertices, " << mesh.faces.size() << " triangles\n";

  // The verifier is given the mesh and the volume alone, and computes the rest itself. Where a
  // sample equals the isovalue, the surface is that of a number just below.
  const deliso::Verification found = deliso::verify(mesh, volume, report.kappa_effective, {});
  std::cout << "components " << found.mesh.components << " of " << found.exact.components
            << ", Euler number " << found.mesh.euler << " for " << found.exact.euler << "\n"
            << "smallest angle " << found.quality.min_angle << " degrees\n"
            << "distance from the surface: mean " << found.to_surface.mean << ", largest "
            << found.to_surface.max << "\n"
            << "restricted Delaunay triangles: " << 100 * found.delaunay.share() << " %\n";

  // In world coordinates, as the volume's file has them. The mesh itself is in the scaled frame:
  // sample (i, j, k) at (i, j, k) times the spacing.
  deliso::write_mesh(mesh, output);
  return found.faults.any() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: mesh_file VOLUME ISOVALUE MESH\n";
    return 2;
  }
  try {
    return mesh_file(argv[1], std::strtod(argv[2], nullptr), argv[3]);
  } catch (const deliso::InputError& error) {  // one line that names the file and the fault
    std::cerr << "mesh_file: " << error.what() << "\n";
    return 2;
  }
}
