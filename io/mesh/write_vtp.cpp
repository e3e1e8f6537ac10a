// SPDX-License-Identifier: MIT
// VTP (VTK XML PolyData): an XML head that describes the arrays, then the raw arrays after the
// underscore of AppendedData, each after its size in bytes. Offsets count from that underscore.
#include "base/text.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

std::string data_array(const char* attributes, std::uint64_t offset) {
  return text("        <DataArray ", attributes, R"( format="appended" offset=")", offset,
              "\"/>\n");
}

}  // namespace

void write_vtp(AtomicFile& out, const WorldMesh& mesh, bool single_precision) {
  const std::uint64_t size_field = sizeof(std::uint64_t);
  const std::uint64_t point_bytes = mesh.vertex_count() * 3 * (single_precision ? 4 : 8);
  const std::uint64_t corner_bytes = mesh.face_count() * 3 * sizeof(std::int64_t);
  const std::uint64_t end_bytes = mesh.face_count() * sizeof(std::int64_t);
  const std::uint64_t corners_at = size_field + point_bytes;
  const std::uint64_t ends_at = corners_at + size_field + corner_bytes;

  out.write("<?xml version=\"1.0\"?>\n" + mesh.comment_line("<!-- ", " -->\n"));
  out.write(
      R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <PolyData>
)");
  if (!mesh.space().empty()) {
    // Text is an array of character codes that ends with 0.
    out.write(R"(    <FieldData>
      <Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">)");
    for (const char c : mesh.space()) out.write(text(static_cast<int>(c), " "));
    out.write("0</Array>\n    </FieldData>\n");
  }
  out.write(text(R"(    <Piece NumberOfPoints=")", mesh.vertex_count(),
                 R"(" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys=")",
                 mesh.face_count(), "\">\n      <Points>\n"));
  out.write(data_array(single_precision ? R"(type="Float32" Name="Points" NumberOfComponents="3")"
                                        : R"(type="Float64" Name="Points" NumberOfComponents="3")",
                       0));
  out.write("      </Points>\n      <Polys>\n");
  out.write(data_array(R"(type="Int64" Name="connectivity")", corners_at));
  out.write(data_array(R"(type="Int64" Name="offsets")", ends_at));
  out.write(R"(      </Polys>
    </Piece>
  </PolyData>
  <AppendedData encoding="raw">
_)");
  put_binary(out, point_bytes);
  for_each_coordinate(mesh, single_precision, [&](auto value, int) { put_binary(out, value); });
  put_binary(out, corner_bytes);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const VertexId v : mesh.triangle(f)) put_binary(out, std::int64_t{v});
  }
  put_binary(out, end_bytes);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    put_binary(out, static_cast<std::int64_t>(3 * (f + 1)));
  }
  out.write("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace deliso
