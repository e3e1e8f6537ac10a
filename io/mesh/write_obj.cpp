// SPDX-License-Identifier: MIT
// OBJ (Wavefront): one statement a line, vertices counted from 1.
#include "io/mesh/mesh_formats.h"

namespace deliso {

void write_obj(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& mesh = objects.front();
  out.write("# DelIso" + mesh.space_note() + "\n" + mesh.comment_line("# ", "\n"));
  for_each_coordinate(mesh, [&](auto value, int axis) {
    if (axis == 0) out.write("v ");
    put_text(out, value, axis == 2 ? '\n' : ' ');
  });
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    out.write("f ");
    for (int i = 0; i < 3; ++i) put_text(out, std::uint64_t{t[i]} + 1, i == 2 ? '\n' : ' ');
  }
}

}  // namespace deliso
