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

}  // namespace

TEST_CASE("polygons in every encoding, type and byte order are read") {
  int files = 0;
  for (const VtkForm& form : all_vtk_forms()) {
    for (const bool wide : {false, true}) {
      CAPTURE(form.format);
      CAPTURE(form.encoding);
      CAPTURE(form.block);
      MeshNotes notes;
      const TriMesh mesh =
          parse_mesh(vtp(kPoints, kPolygons, form, wide), MeshFormat::vtp, "in", &notes);
      CHECK(mesh.points == kPoints);
      REQUIRE(mesh.faces.size() == kTriangles.size());
      for (FaceId f = 0; f < kTriangles.size(); ++f) CHECK(mesh.faces[f].v == kTriangles[f]);
      CHECK(notes.comments == std::vector<std::string>{"made by hand"});
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
