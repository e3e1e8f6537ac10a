// SPDX-License-Identifier: MIT
// VTP (VTK XML PolyData): an XML head that describes the arrays, then the raw arrays after the
// underscore of AppendedData, each after its size in bytes. Offsets count from that underscore.
#include "base/text.h"
#include "io/mesh/label_numbers.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

std::string data_array(const char* attributes, std::uint64_t offset) {
  return text("        <DataArray ", attributes, R"( format="appended" offset=")", offset,
              "\"/>\n");
}

}  // namespace

void write_vtp(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& head = objects.front();
  const MeshWriteOptions& options = head.options();
  const bool single_precision = options.single_precision;
  std::uint64_t points = 0, facets = 0;
  for (const WorldMesh& mesh : objects) {
    points += mesh.vertex_count();
    facets += mesh.face_count();
  }
  // Offsets of the arrays, in the order of writing.
  std::uint64_t end = 0;
  const auto place = [&](std::uint64_t bytes) {
    const std::uint64_t begin = end;
    end += sizeof(std::uint64_t) + bytes;
    return begin;
  };
  const std::uint64_t point_bytes = points * 3 * (single_precision ? 4 : 8);
  const std::uint64_t corner_bytes = facets * 3 * sizeof(std::int64_t);
  const std::uint64_t end_bytes = facets * sizeof(std::int64_t);
  const std::uint64_t normal_bytes = points * 3 * sizeof(float);
  const std::uint64_t value_bytes = facets * 4;  // of components or distances
  const bool short_labels = LabelNumbers(options).all_fit();
  const std::uint64_t side_bytes = facets * (short_labels ? 4 : 8);
  const std::uint64_t color_bytes = facets * 3;
  const std::uint64_t points_at = place(point_bytes), corners_at = place(corner_bytes);
  const std::uint64_t ends_at = place(end_bytes);

  out.write("<?xml version=\"1.0\"?>\n" + head.comment_line("<!-- ", " -->\n"));
  out.write(
      R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <PolyData>
)");
  if (!head.space().empty()) {
    // Text is an array of character codes that ends with 0.
    out.write(R"(    <FieldData>
      <Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">)");
    for (const char c : head.space()) out.write(text(static_cast<int>(c), " "));
    out.write("0</Array>\n    </FieldData>\n");
  }
  out.write(text(R"(    <Piece NumberOfPoints=")", points,
                 R"(" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys=")",
                 facets, "\">\n"));
  if (options.attributes) {
    out.write("      <PointData Normals=\"Normals\">\n");
    out.write(
        data_array(R"(type="Float32" Name="Normals" NumberOfComponents="3")", place(normal_bytes)));
    out.write("      </PointData>\n");
  }
  if (options.attributes || options.label || !options.sides.empty()) {
    out.write("      <CellData>\n");
    if (options.attributes) {
      out.write(data_array(R"(type="Int32" Name="component")", place(value_bytes)));
      out.write(data_array(R"(type="Float32" Name="distance")", place(value_bytes)));
      if (options.first_cap) out.write(data_array(R"(type="UInt8" Name="cap")", place(facets)));
    }
    if (options.label) {
      out.write(data_array(R"(type="Int64" Name="label")", place(end_bytes)));
      out.write(
          data_array(R"(type="UInt8" Name="color" NumberOfComponents="3")", place(color_bytes)));
    }
    if (!options.sides.empty()) {
      for (const char* name : {"label_front", "label_behind"}) {
        const std::string type = text("type=\"", short_labels ? "Int32" : "Int64", "\" Name=\"");
        out.write(data_array((type + name + "\"").c_str(), place(side_bytes)));
      }
    }
    out.write("      </CellData>\n");
  }
  out.write("      <Points>\n");
  out.write(data_array(single_precision ? R"(type="Float32" Name="Points" NumberOfComponents="3")"
                                        : R"(type="Float64" Name="Points" NumberOfComponents="3")",
                       points_at));
  out.write("      </Points>\n      <Polys>\n");
  out.write(data_array(R"(type="Int64" Name="connectivity")", corners_at));
  out.write(data_array(R"(type="Int64" Name="offsets")", ends_at));
  out.write(R"(      </Polys>
    </Piece>
  </PolyData>
  <AppendedData encoding="raw">
_)");
  // Writes an array. `put(mesh, f)`: its value of a facet.
  const auto put_facets = [&](std::uint64_t bytes, auto put) {
    put_binary(out, bytes);
    for (const WorldMesh& mesh : objects) {
      for (std::size_t f = 0; f < mesh.face_count(); ++f) put(mesh, f);
    }
  };
  put_binary(out, point_bytes);
  for (const WorldMesh& mesh : objects) {
    for_each_coordinate(mesh, [&](auto value, int) { put_binary(out, value); });
  }
  put_binary(out, corner_bytes);
  std::int64_t first = 0;  // vertex of the object
  for (const WorldMesh& mesh : objects) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      for (const VertexId v : mesh.triangle(f)) put_binary(out, first + std::int64_t{v});
    }
    first += static_cast<std::int64_t>(mesh.vertex_count());
  }
  put_binary(out, end_bytes);
  for (std::uint64_t f = 0; f < facets; ++f)
    put_binary(out, static_cast<std::int64_t>(3 * (f + 1)));
  if (options.attributes) {
    put_binary(out, normal_bytes);
    for (const WorldMesh& mesh : objects) {
      for (const auto& normal : mesh.options().attributes->normals) {
        for (const float x : normal) put_binary(out, x);
      }
    }
    put_facets(value_bytes, [&](const WorldMesh& mesh, std::size_t f) {
      put_binary(out, mesh.options().attributes->component[f]);
    });
    put_facets(value_bytes, [&](const WorldMesh& mesh, std::size_t f) {
      put_binary(out, mesh.options().attributes->distance[f]);
    });
    if (options.first_cap) {
      put_facets(facets, [&](const WorldMesh& mesh, std::size_t f) {
        put_binary(out, std::uint8_t{f >= *mesh.options().first_cap});
      });
    }
  }
  if (options.label) {
    put_facets(end_bytes, [&](const WorldMesh& mesh, std::size_t) {
      put_binary(out, mesh.options().label->number);
    });
    put_facets(color_bytes, [&](const WorldMesh& mesh, std::size_t) {
      for (const std::uint8_t byte : mesh.options().label->color) put_binary(out, byte);
    });
  }
  for (std::size_t n = 0; n < 2 && !options.sides.empty(); ++n) {
    put_binary(out, side_bytes);
    for (const auto& labels : options.sides) {
      short_labels ? put_binary(out, static_cast<std::int32_t>(labels[n]))
                   : put_binary(out, labels[n]);
    }
  }
  out.write("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace deliso
