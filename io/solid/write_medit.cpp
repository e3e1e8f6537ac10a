// SPDX-License-Identifier: MIT
// Medit's .mesh (Frey 2001, "Medit: an interactive mesh visualization software"): keywords, each
// with a count and as many lines, numbered from 1. The last number of a line is a reference: of a
// triangle its marker, of a tetrahedron its region.
#include "io/solid/solid_formats.h"

namespace deliso {

void write_medit(const MarkedSolid& marked, const std::string& path) {
  const Solid& solid = marked.solid;
  AtomicFile out(path);
  out.write("MeshVersionFormatted 2\n");
  put_head(out, marked, "# ", "\n");
  out.write("Dimension 3\nVertices\n");
  put_text(out, solid.points.size(), '\n');
  for (const Vec3& p : solid.points) {
    put_point(out, p, ' ');
    out.write("0\n");
  }
  out.write("Triangles\n");
  put_text(out, solid.walls.size(), '\n');
  for (std::size_t w = 0; w < solid.walls.size(); ++w) {
    for (const VertexId v : solid.walls[w].v) put_text(out, std::uint64_t{v} + 1, ' ');
    put_text(out, marked.markers[w], '\n');
  }
  out.write("Tetrahedra\n");
  put_text(out, solid.cells.size(), '\n');
  for (std::size_t c = 0; c < solid.cells.size(); ++c) {
    for (const VertexId v : solid.cells[c]) put_text(out, std::uint64_t{v} + 1, ' ');
    put_text(out, marked.numbers[solid.regions[c] - 1], '\n');
  }
  out.write("End\n");
  out.commit();
}

}  // namespace deliso
