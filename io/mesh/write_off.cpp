// SPDX-License-Identifier: MIT
// OFF (Geomview): counts, then vertices, then facets counted from 0.
#include "io/mesh/mesh_formats.h"

namespace deliso {

void write_off(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& mesh = objects.front();
  out.write("OFF\n" + mesh.space_line("# ", "\n") + mesh.comment_line("# ", "\n"));
  put_text(out, mesh.vertex_count(), ' ');
  put_text(out, mesh.face_count(), ' ');
  out.write("0\n");  // the number of edges, which readers ignore
  for_each_coordinate(mesh,
                      [&](auto value, int axis) { put_text(out, value, axis == 2 ? '\n' : ' '); });
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    out.write("3 ");
    for (int i = 0; i < 3; ++i) put_text(out, t[i].number(), i == 2 ? '\n' : ' ');
  }
}

}  // namespace deliso
