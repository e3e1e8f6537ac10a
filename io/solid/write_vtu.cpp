// SPDX-License-Identifier: MIT
// VTU (VTK XML UnstructuredGrid), laid out as io/mesh/write_vtp.cpp does: an XML head that
// describes the arrays, then the raw arrays after the underscore of AppendedData, each after its
// size.
#include "base/text.h"
#include "io/solid/solid_formats.h"

namespace deliso {

void write_vtu(const MarkedSolid& marked, const std::string& path) {
  constexpr std::uint8_t kTetrahedron = 10;  // VTK_TETRA
  const Solid& solid = marked.solid;
  const std::uint64_t points = solid.points.size(), cells = solid.cells.size();
  AtomicFile out(path);
  out.write("<?xml version=\"1.0\"?>\n");
  put_head(out, marked, "<!-- ", " -->\n");
  out.write(
      R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <UnstructuredGrid>
)");
  std::uint64_t end = 0;
  const auto array = [&](const char* attributes, std::uint64_t bytes) {
    out.write(
        text("        <DataArray ", attributes, R"( format="appended" offset=")", end, "\"/>\n"));
    end += sizeof(std::uint64_t) + bytes;
  };
  out.write(text(R"(    <Piece NumberOfPoints=")", points, R"(" NumberOfCells=")", cells,
                 "\">\n      <CellData>\n"));
  array(R"(type="Int64" Name="region")", cells * 8);
  out.write("      </CellData>\n      <Points>\n");
  array(R"(type="Float64" Name="Points" NumberOfComponents="3")", points * 24);
  out.write("      </Points>\n      <Cells>\n");
  array(R"(type="Int64" Name="connectivity")", cells * 32);
  array(R"(type="Int64" Name="offsets")", cells * 8);
  array(R"(type="UInt8" Name="types")", cells);
  out.write(R"(      </Cells>
    </Piece>
  </UnstructuredGrid>
  <AppendedData encoding="raw">
_)");
  put_binary(out, cells * 8);
  for (const RegionId r : solid.regions) put_binary(out, marked.labels[r - 1]);
  put_binary(out, points * 24);
  for (const Vec3& p : solid.points) {
    for (int axis = 0; axis < 3; ++axis) put_binary(out, p[axis]);
  }
  put_binary(out, cells * 32);
  for (const Tetrahedron& corners : solid.cells) {
    for (const VertexId v : corners) put_binary(out, std::int64_t{v});
  }
  put_binary(out, cells * 8);
  for (std::uint64_t c = 1; c <= cells; ++c) put_binary(out, static_cast<std::int64_t>(4 * c));
  put_binary(out, cells);
  for (std::uint64_t c = 0; c < cells; ++c) put_binary(out, kTetrahedron);
  out.write("\n  </AppendedData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace deliso
