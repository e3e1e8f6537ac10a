// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names the elements and their types, then the data.
#include "base/text.h"
#include "mesh/mesh_formats.h"

namespace deliso {

void write_ply(AtomicFile& out, const WorldMesh& mesh, bool single_precision, bool ascii) {
  const char* coordinate = single_precision ? "float" : "double";
  out.write("ply\nformat ");
  out.write(ascii ? "ascii" : "binary_little_endian");
  out.write(text(" 1.0\ncomment DelIso", mesh.space_note(), "\n",
                 mesh.comment_line("comment ", "\n"), "element vertex ", mesh.vertex_count(),
                 "\n"));
  for (const char* axis : {"x", "y", "z"}) {
    out.write(text("property ", coordinate, " ", axis, "\n"));
  }
  out.write(text("element face ", mesh.face_count(), "\n"));
  out.write("property list uchar int vertex_indices\nend_header\n");

  if (ascii) {
    for_each_coordinate(mesh, single_precision, [&](auto value, int axis) {
      put_text(out, value, axis == 2 ? '\n' : ' ');
    });
  } else {
    for_each_coordinate(mesh, single_precision, [&](auto value, int) { put_binary(out, value); });
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    if (ascii) {
      out.write("3 ");
      for (int i = 0; i < 3; ++i) put_text(out, t[i], i == 2 ? '\n' : ' ');
    } else {
      put_binary(out, std::uint8_t{3});
      for (const VertexId v : t) put_binary(out, v);
    }
  }
}

}  // namespace deliso
