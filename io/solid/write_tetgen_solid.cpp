// SPDX-License-Identifier: MIT
// TetGen's .node, .ele and .face (TetGen's manual, chapter 5): points, tetrahedra with their
// region, and walls with their marker, all numbered from 0.
#include "base/text.h"
#include "io/solid/solid_formats.h"

namespace deliso {

void write_tetgen_solid(const MarkedSolid& marked, const std::string& path) {
  const Solid& solid = marked.solid;
  const std::vector<std::string> paths = solid_files(path, SolidFormat::tetgen);
  AtomicFile node(paths[0]), ele(paths[1]), face(paths[2]);
  put_head(node, marked, "# ", "\n");
  put_text(node, solid.points.size(), ' ');
  node.write("3 0 0\n");  // dimensions, values and markers of points
  for (std::size_t v = 0; v < solid.points.size(); ++v) {
    put_text(node, v, ' ');
    put_point(node, solid.points[VertexId(v)], '\n');
  }
  put_text(ele, solid.cells.size(), ' ');
  ele.write("4 1\n");  // corners and values
  for (std::size_t c = 0; c < solid.cells.size(); ++c) {
    put_text(ele, c, ' ');
    for (const VertexId v : solid.cells[c]) put_text(ele, v.number(), ' ');
    put_text(ele, marked.numbers[solid.regions[c] - 1], '\n');
  }
  put_text(face, solid.walls.size(), ' ');
  face.write("1\n");  // walls have markers
  for (std::size_t w = 0; w < solid.walls.size(); ++w) {
    put_text(face, w, ' ');
    for (const VertexId v : solid.walls[w].v) put_text(face, v.number(), ' ');
    put_text(face, marked.markers[w], '\n');
  }
  for (AtomicFile* file : {&node, &ele, &face}) file->complete();
  for (AtomicFile* file : {&node, &ele, &face}) file->commit();
}

}  // namespace deliso
