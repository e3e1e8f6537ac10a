// SPDX-License-Identifier: MIT
// The library's use in a few lines, as the README shows it: a volume in, a mesh out, where the
// volume lies in the world. Usage: consumer VOLUME ISOVALUE MESH
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "deliso/base/version.h"
#include "deliso/io/mesh/write_mesh.h"
#include "deliso/io/volume/read_volume.h"
#include "deliso/mesh_isosurface.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const deliso::Volume volume = deliso::read_volume(argv[1]);
    const deliso::TriMesh mesh = deliso::mesh_isosurface(volume, std::strtod(argv[2], nullptr));
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

    // A function over a box of the world, and the points of its mesh there.
    const auto height = [](const deliso::Vec3& p) { return p.z; };
    const deliso::Box3 box{{10, 20, 30}, {11, 21, 31}};
    const deliso::TriMesh plane =
        deliso::mesh_isosurface(deliso::Volume::from_function(box, {3, 4, 5}, height), 30.6);
    for (const deliso::Vec3& p : plane.world_points()) {
      if (!box.contains(p) || std::fabs(p.z - 30.6) > 1e-12) return 1;
    }
    return mesh.faces.empty() || plane.faces.empty() ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 2;
  }
}
