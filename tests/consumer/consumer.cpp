// SPDX-License-Identifier: MIT
// The library's use in a few lines, as the README shows it: a volume in, a mesh out, where the
// volume lies in the world. Usage: consumer VOLUME ISOVALUE MESH
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "deliso/base/version.h"
#include "deliso/deliso.h"
#include "deliso/io/mesh/write_mesh.h"
#include "deliso/io/volume/read_volume.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const deliso::Volume volume = deliso::read_volume(argv[1]);
    deliso::value_range(volume);  // throws InputError for a NaN or infinite sample
    deliso::Report report;
    const deliso::TriMesh mesh =
        deliso::mesh_isosurface(volume, std::strtod(argv[2], nullptr), {}, report);
    deliso::write_mesh(mesh, argv[3]);
    std::printf("deliso %s: %zu triangles\n", deliso::kVersion.data(), mesh.faces.size());

    // Samples of one's own, with a place in the world; too few of them are a fault to be caught.
    deliso::Frame frame;
    frame.origin = {10, 20, 30};
    const std::vector<float> samples(8, 0.5f);
    deliso::Volume::from_samples({2, 2, 2}, {1, 1, 1}, samples, frame);
    try {
      deliso::Volume::from_samples({2, 2, 3}, {1, 1, 1}, samples, frame);
      return 1;
    } catch (const deliso::InputError&) {
    }
    return mesh.faces.empty() ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 2;
  }
}
