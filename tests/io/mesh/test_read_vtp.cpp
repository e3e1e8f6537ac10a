// SPDX-License-Identifier: MIT
// VTP: what VTK writes, in each of its encodings, is one and the same mesh.
#include <doctest/doctest.h>

#include "base/check.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/read_mesh.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

const std::vector<Vec3> kPoints{{0, 0, -1}, {1, 0, -1}, {1, 1.5, -1}, {0, 1, -1}, {2, 2, -1}};
const std::vector<std::vector<VertexId>> kPolygons{{0, 1, 2, 3}, {2, 4, 3}};
const Triangles kTriangles{{0, 1, 2}, {0, 2, 3}, {2, 4, 3}};

std::string vtp_error(const std::string& bytes) {
  try {
    parse_mesh(bytes, MeshFormat::vtp, "in");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string file, const std::string& old, const std::string& now) {
  const std::size_t at = file.find(old);
  REQUIRE(at != std::string::npos);
  return file.replace(at, old.size(), now);
}

}  // namespace

TEST_CASE("polygons in every encoding, type and byte order are read") {
  int files = 0;
  for (const VtkForm& form : all_vtk_forms()) {
    for (const bool wide : {false, true}) {
      CAPTURE(form.format);
      CAPTURE(form.encoding);
      CAPTURE(form.block);
      std::vector<std::string> comments;
      const TriMesh mesh =
          parse_mesh(vtp(kPoints, kPolygons, form, wide), MeshFormat::vtp, "in", &comments);
      CHECK(mesh.points == kPoints);
      REQUIRE(mesh.faces.size() == kTriangles.size());
      for (FaceId f = 0; f < kTriangles.size(); ++f) CHECK(mesh.faces[f].v == kTriangles[f]);
      CHECK(comments == std::vector<std::string>{"made by hand"});
      // No polygons, nothing at all.
      CHECK(parse_mesh(vtp(kPoints, {}, form, wide), MeshFormat::vtp, "in").points == kPoints);
      CHECK(parse_mesh(vtp({}, {}, form, wide), MeshFormat::vtp, "in").points.empty());
      ++files;
    }
  }
  CHECK(files == 74);
}

TEST_CASE("text of single precision is read as floats") {
  const std::string file = vtp({{0.1, 0.2, 0.3}}, {}, {.format = "ascii"}, false);
  CHECK(file.find("0.1 0.2 0.3") != std::string::npos);
  const TriMesh mesh = parse_mesh(file, MeshFormat::vtp, "in");
  REQUIRE(mesh.points.size() == 1);
  CHECK(mesh.points[0].x == static_cast<double>(0.1f));
}

TEST_CASE("each fault of a VTP file has its message") {
  const std::string words = vtp(kPoints, kPolygons, {.format = "ascii"}, true);
  const std::string raw = vtp(kPoints, kPolygons, {}, true);
  const auto text_with = [&](const std::string& old, const std::string& now) {
    return vtp_error(replaced(words, old, now));
  };
  CHECK(vtp_error(words) == "no error");
  CHECK(vtp_error("") == "'in': is no VTK XML file");
  CHECK(text_with("PolyData", "ImageData") ==
        "'in': is a VTK file of type 'ImageData': only PolyData holds a mesh");
  CHECK(text_with("</Piece>", "</Piece><Piece>") ==
        "'in': has several pieces: only one is supported");
  CHECK(text_with("Strips=\"0\"", "Strips=\"2\"") ==
        "'in': has triangle strips, which are not supported");
  CHECK(text_with("Points=\"5\"", "Points=\"x\"") == "'in': attribute NumberOfPoints is 'x'");
  CHECK(text_with("Points=\"5\"", "Points=\"4294967295\"") ==
        "'in': 4294967295 points are too many");
  CHECK(text_with("Points=\"5\"", "Points=\"6\"") ==
        "'in': data is too short: the coordinates of 6 points need 18 numbers");
  CHECK(text_with("Points=\"5\"", "Points=\"4\"") ==
        "'in': more than 12 numbers for the coordinates of 4 points");
  CHECK(text_with("Polys=\"2\"", "Polys=\"3\"") ==
        "'in': data is too short: the offsets of 3 polygons need 3 numbers");
  CHECK(text_with("\n4 7 ", "\n4 6 ") == "'in': polygon 1 ends at corner 6, the one before at 4");
  CHECK(text_with("\n4 7 ", "\n4 -7 ") == "'in': polygon 1 ends at corner -7, the one before at 4");
  CHECK(text_with("\n4 7 ", "\n4 8 ") ==
        "'in': data is too short: the corners of 2 polygons need 8 numbers");
  CHECK(text_with("2 4 3 ", "2 5 3 ") == "'in': a corner of polygon 1 is 5, not one of 5 points");
  CHECK(text_with("2 4 3 ", "2 four 3 ") == "'in': there is 'four' in place of a number");
  CHECK(text_with("Name=\"offsets\" NumberOfComponents=\"1\" format=\"ascii\">\n4",
                  "Name=\"onsets\" NumberOfComponents=\"1\" format=\"ascii\">\n4") ==
        "'in': has no array for the offsets of 2 polygons");
  CHECK(vtp_error(replaced(raw, "NumberOfPoints=\"5\"", "NumberOfPoints=\"6\"")) ==
        "'in': the coordinates of 6 points need 144 bytes, the array holds 120");
  CHECK(vtp_error(
            replaced(raw, "type=\"Float64\" Name=\"Points\"", "type=\"String\" Name=\"Points\"")) ==
        "'in': type 'String' of the coordinates of 5 points is not supported");
  CHECK(vtp_error(replaced(raw, "<AppendedData", "<Nothing")) == "'in': has no AppendedData");
  CHECK(vtp_error(raw.substr(0, raw.size() - 60))
            .starts_with("'in': data is too short: the corners of 2 polygons need 56 bytes"));
  CHECK(text_with("</PolyData>", "") == "'in': ends before </PolyData>");
}
