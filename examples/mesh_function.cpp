// SPDX-License-Identifier: MIT
// A function of your own, sampled on a grid and meshed: a torus, whose volume is known. The surface
// that is meshed is that of the trilinear interpolant, so the volume is off by the square of the
// grid's step: each halving of it takes the error to a quarter.
// Usage: mesh_function [MESH]
#include <cmath>
#include <iostream>
#include <numbers>

#include "deliso/base/check.h"
#include "deliso/check/quality.h"
#include "deliso/io/mesh/write_mesh.h"
#include "deliso/mesh_isosurface.h"
#include "deliso/volume/volume.h"

namespace {

constexpr double kRing = 0.6, kTube = 0.25;  // radii of the torus, in [-1, 1]^3

// Says how much of the torus is missing, at three steps of the grid.
void mesh_torus(const char* output) {
  // The inside is where the function is at least the isovalue: minus the distance from the surface.
  const auto torus = [](const deliso::Vec3& p) {
    const double from_ring = std::sqrt(p.x * p.x + p.y * p.y) - kRing;
    return kTube - std::sqrt(from_ring * from_ring + p.z * p.z);
  };
  const double exact = 2 * std::numbers::pi * std::numbers::pi * kRing * kTube * kTube;

  for (const int n : {17, 33, 65}) {
    const deliso::Volume volume =
        deliso::Volume::from_function({{-1, -1, -1}, {1, 1, 1}}, {n, n, n}, torus);
    // As fine as it gets, so that what is missing is due to the grid.
    deliso::Options options;
    options.limits[deliso::Criterion::distance] = {0.001, deliso::Length::Unit::voxel};
    deliso::Report report;
    const deliso::TriMesh mesh = deliso::mesh_isosurface(volume, 0, options, report);
    std::cout << n << "^3 samples: " << mesh.faces.size() << " triangles, Euler number "
              << report.exact.euler << ", volume too small by "
              << exact - deliso::enclosed_volume(mesh) << "\n";
    if (output) deliso::write_mesh(mesh, output);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    mesh_torus(argc > 1 ? argv[1] : nullptr);
  } catch (const deliso::InputError& error) {  // the file could not be written
    std::cerr << "mesh_function: " << error.what() << "\n";
    return 2;
  }
}
