// SPDX-License-Identifier: MIT
// .smesh and .poly (TetGen's manual, section 5.2): vertices with their numbers, facets with a
// marker, then the lists of holes and regions, both empty. A facet is one polygon: .smesh has it in
// one line, .poly after a line with the number of its polygons and holes.
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

void write_tetgen(AtomicFile& out, const WorldMesh& mesh, bool as_poly) {
  const std::optional<std::size_t>& first_cap = mesh.options().first_cap;
  // Boundary faces of the tetrahedra get these markers; TetGen gives 0 to faces inside.
  constexpr int kSurface = 1, kCap = 2;
  out.write("# DelIso" + mesh.space_note() + "\n" + mesh.comment_line("# ", "\n"));
  put_text(out, mesh.vertex_count(), ' ');
  out.write("3 0 0\n");  // dimensions, values and markers of vertices
  std::size_t v = 0;
  for_each_coordinate(mesh, [&](auto value, int axis) {
    if (axis == 0) put_text(out, v++, ' ');
    put_text(out, value, axis == 2 ? '\n' : ' ');
  });
  put_text(out, mesh.face_count(), ' ');
  out.write("1\n");  // facets have markers
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    const int marker = first_cap && f >= *first_cap ? kCap : kSurface;
    if (as_poly) {
      out.write("1 0 ");
      put_text(out, marker, '\n');
    }
    out.write("3 ");
    for (int i = 0; i < 3; ++i) put_text(out, t[i].number(), as_poly && i == 2 ? '\n' : ' ');
    if (!as_poly) put_text(out, marker, '\n');
  }
  out.write("0\n0\n");
}

}  // namespace

void write_smesh(AtomicFile& out, std::span<const WorldMesh> objects) {
  write_tetgen(out, objects.front(), false);
}

void write_poly(AtomicFile& out, std::span<const WorldMesh> objects) {
  write_tetgen(out, objects.front(), true);
}

}  // namespace deliso
