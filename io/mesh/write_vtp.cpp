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

void write_vtp(AtomicFile& out, const WorldMesh& mesh, const MeshWriteOptions& options) {
  const bool single_precision = options.single_precision;
  const std::uint64_t size_field = sizeof(std::uint64_t);
  const std::uint64_t point_bytes = mesh.vertex_count() * 3 * (single_precision ? 4 : 8);
  const std::uint64_t corner_bytes = mesh.face_count() * 3 * sizeof(std::int64_t);
  const std::uint64_t end_bytes = mesh.face_count() * sizeof(std::int64_t);
  const std::uint64_t corners_at = size_field + point_bytes;
  const std::uint64_t ends_at = corners_at + size_field + corner_bytes;
  const std::uint64_t normal_bytes = mesh.vertex_count() * 3 * sizeof(float);
  const std::uint64_t value_bytes = mesh.face_count() * 4;  // of components, or of distances
  const std::uint64_t normals_at = ends_at + size_field + end_bytes;
  const std::uint64_t components_at = normals_at + size_field + normal_bytes;
  const std::uint64_t distances_at = components_at + size_field + value_bytes;
  const std::uint64_t caps_at = distances_at + size_field + value_bytes;

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
                 mesh.face_count(), "\">\n"));
  if (options.attributes) {
    out.write("      <PointData Normals=\"Normals\">\n");
    out.write(data_array(R"(type="Float32" Name="Normals" NumberOfComponents="3")", normals_at));
    out.write("      </PointData>\n      <CellData>\n");
    out.write(data_array(R"(type="Int32" Name="component")", components_at));
    out.write(data_array(R"(type="Float32" Name="distance")", distances_at));
    if (options.first_cap) out.write(data_array(R"(type="UInt8" Name="cap")", caps_at));
    out.write("      </CellData>\n");
  }
  if (!options.sides.empty()) {
    out.write("      <CellData>\n");
    out.write(data_array(R"(type="Int32" Name="label_front")", normals_at));
    out.write(
        data_array(R"(type="Int32" Name="label_behind")", normals_at + size_field + value_bytes));
    out.write("      </CellData>\n");
  }
  out.write("      <Points>\n");
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
  if (options.attributes) {
    put_binary(out, normal_bytes);
    for (const auto& normal : options.attributes->normals) {
      for (const float x : normal) put_binary(out, x);
    }
    put_binary(out, value_bytes);
    for (const std::uint32_t component : options.attributes->component) put_binary(out, component);
    put_binary(out, value_bytes);
    for (const float distance : options.attributes->distance) put_binary(out, distance);
    if (options.first_cap) {
      put_binary(out, std::uint64_t{mesh.face_count()});
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        put_binary(out, std::uint8_t{f >= *options.first_cap});
      }
    }
  }
  for (std::size_t n = 0; n < 2 && !options.sides.empty(); ++n) {
    put_binary(out, value_bytes);
    for (const auto& labels : options.sides) put_binary(out, labels[n]);
  }
  out.write("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace deliso
