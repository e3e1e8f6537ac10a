// SPDX-License-Identifier: MIT
// The library's use in a few lines: a volume in, a mesh out.
#include <cstdio>

#include "base/version.h"
#include "deliso/deliso.h"
#include "mesh/write_mesh.h"
#include "volume/read_volume.h"

int main(int argc, char** argv) {
  const deliso::Volume volume = deliso::read_volume("builtin:torus");
  deliso::Report report;
  const deliso::TriMesh mesh = deliso::mesh_isosurface(volume, 0.0, {}, report);
  if (argc > 1) deliso::write_mesh(mesh, argv[1]);
  std::printf("deliso %s: %zu triangles\n", deliso::kVersion.data(), mesh.faces.size());
  return mesh.faces.empty() ? 1 : 0;
}
