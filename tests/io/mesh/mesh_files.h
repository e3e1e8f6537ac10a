// SPDX-License-Identifier: MIT
// Meshes as other programs write them, in the forms that write_mesh does not use.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "base/text.h"
#include "io/files/vtk_array.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

// Numbers as an array of T: text, or bytes in the form's order.
template <class T>
std::string vtk_numbers(const std::vector<double>& values, const VtkForm& form,
                        std::uint64_t seed) {
  std::string out;
  for (const double value : values) {
    if (form.format == "ascii") {
      out += text(static_cast<T>(value), out.size() % 70 > 60 ? "\n" : " ");
      continue;
    }
    const T number = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (form.order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
  }
  return form.format == "ascii" ? out : vtk_array(out, form, seed);
}

// An element with what VTK notes in it beside the numbers.
inline std::string vtk_element(const std::string& tag, const std::string& numbers) {
  return tag + ">\n" + numbers +
         "\n<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"1\">"
         "<Value index=\"0\">0</Value></InformationKey>\n</DataArray>\n";
}

// VTP of polygons, with a vertex cell, a line, and arrays of data beside, as VTK writes them. With
// `wide`, Float64 and Int64, else Float32 and Int32.
inline std::string vtp(const std::vector<Vec3>& points,
                       const std::vector<std::vector<VertexId>>& polygons, const VtkForm& form,
                       bool wide) {
  std::vector<double> coordinates, corners, ends;
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(p[axis]);
  }
  for (const auto& polygon : polygons) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    ends.push_back(static_cast<double>(corners.size()));
  }
  std::string appended;
  std::uint64_t seed = 1;
  const auto array = [&](const char* name, const std::vector<double>& values, bool real,
                         int components) {
    const std::string block = real   ? wide ? vtk_numbers<double>(values, form, ++seed)
                                            : vtk_numbers<float>(values, form, ++seed)
                                : wide ? vtk_numbers<std::int64_t>(values, form, ++seed)
                                     : vtk_numbers<std::int32_t>(values, form, ++seed);
    std::string tag =
        text("<DataArray type=\"", real ? "Float" : "Int", wide ? 64 : 32, "\" Name=\"", name,
             "\" NumberOfComponents=\"", components, "\" format=\"", form.format, "\"");
    if (form.format != "appended") return vtk_element(tag, block);
    tag += text(" offset=\"", appended.size(), "\"");
    appended += block;
    return vtk_element(tag, "");
  };
  std::string file =
      "<?xml version=\"1.0\"?>\n<!-- made by hand -->\n<VTKFile type=\"PolyData\" "
      "version=\"1.0\" byte_order=\"";
  file += form.order == std::endian::little ? "LittleEndian\"" : "BigEndian\"";
  if (form.header_size == 8) file += " header_type=\"UInt64\"";
  if (form.block > 0) file += " compressor=\"vtkZLibDataCompressor\"";
  file += text(">\n<PolyData>\n<Piece NumberOfPoints=\"", points.size(),
               "\" NumberOfVerts=\"1\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
               "NumberOfPolys=\"",
               polygons.size(), "\">\n<PointData>\n");
  file += array("Normals", coordinates, true, 3) + "</PointData>\n<CellData/>\n<Points>\n";
  file += array("Points", coordinates, true, 3) + "</Points>\n<Verts>\n";
  // One statement each: their data is appended in the order of the calls.
  file += array("connectivity", {0}, false, 1);
  file += array("offsets", {1}, false, 1);
  file += "</Verts>\n<Lines/>\n<Strips/>\n<Polys>\n";
  file += array("offsets", ends, false, 1);
  file += array("connectivity", corners, false, 1);
  file += "</Polys>\n</Piece>\n</PolyData>\n";
  if (form.format == "appended")
    file += "<AppendedData encoding=\"" + form.encoding + "\">\n   _" + appended +
            "\n</AppendedData>\n";
  return file + "</VTKFile>\n";
}

// A square and a triangle, and the triangles that they are cut into.
inline const std::vector<Vec3> kRichPoints{
    {0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}, {2, 2, -1}};
inline const std::vector<std::vector<VertexId>> kRichPolygons{{0, 1, 2, 3}, {2, 4, 3}};
inline const std::vector<Triangle> kRichTriangles{{0, 1, 2}, {0, 2, 3}, {2, 4, 3}};

inline std::vector<VtkForm> all_vtk_forms() {
  std::vector<VtkForm> all{{"ascii", "", std::endian::little, 4, 0}};
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const int header : {4, 8}) {
      for (const std::size_t block : {0, 20, 1000}) {
        for (const char* encoding : {"raw", "base64"})
          all.push_back({"appended", encoding, order, header, block});
        all.push_back({"binary", "", order, header, block});
      }
    }
  }
  return all;
}

// ASCII STL, with the coordinates rounded to float.
inline std::string stl_text(const TriMesh& mesh, const char* end = "\n") {
  std::string file = text("solid made by hand", end);
  for (const Face& face : mesh.faces) {
    file += text("  facet normal 0 nan 1", end, "    outer loop", end);
    for (const VertexId v : face.v) {
      const Vec3& p = mesh.points[v];
      file += text("      vertex ", static_cast<float>(p.x), " ", static_cast<float>(p.y), " ",
                   static_cast<float>(p.z), end);
    }
    file += text("    endloop", end, "  endfacet", end);
  }
  return file + text("endsolid made by hand", end);
}

}  // namespace deliso::test
