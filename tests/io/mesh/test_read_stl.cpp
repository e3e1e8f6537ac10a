// SPDX-License-Identifier: MIT
// STL: the triangles that were written come back, their corners joined where they were one vertex.
#include <doctest/doctest.h>

#include <cmath>

#include "base/check.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/read_mesh.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

TriMesh read(const std::string& bytes, MeshNotes* notes = nullptr) {
  return parse_mesh(bytes, MeshFormat::stl, "in", notes);
}

std::string binary_stl(const TriMesh& mesh, const std::string& comment = "") {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / "a.stl", {.comment = comment});
  return file_bytes(folder / "a.stl");
}

float as_float(double x) {
  volatile float single = static_cast<float>(x);  // GCC 12's vectorizer drops the conversion
  return single;
}

// The triangles by the places of their corners.
void check_same_places(const TriMesh& a, const TriMesh& b) {
  REQUIRE(a.faces.size() == b.faces.size());
  for (FaceId f = 0; f < a.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = a.points[a.faces[f].v[i]], q = b.points[b.faces[f].v[i]];
      for (int axis = 0; axis < 3; ++axis) REQUIRE(as_float(p[axis]) == as_float(q[axis]));
      CHECK((a.faces[f].n[i] == kNoId) == (b.faces[f].n[i] == kNoId));
    }
  }
}

}  // namespace

TEST_CASE("both kinds give the same triangles and number of vertices") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    RandomMesh source(seed % 2 ? torus_grid(4, 5) : l_shape(), seed);
    for (int i = 0; i < 25; ++i) source.change();
    TriMesh mesh = source.mesh();
    for (Vec3& p : mesh.points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = source.random().uniform(-10, 10);
    }
    std::vector<bool> used(mesh.points.size(), false);
    for (const Face& face : mesh.faces) {
      for (const VertexId v : face.v) used[v] = true;
    }
    const auto vertices = static_cast<std::size_t>(std::ranges::count(used, true));
    for (const std::string& bytes : {binary_stl(mesh), stl_text(mesh), stl_text(mesh, "\r\n")}) {
      const TriMesh back = read(bytes);
      check_same_places(back, mesh);
      CHECK(back.points.size() == vertices);
      // Vertices are counted as they come.
      VertexId next = 0;
      for (const Face& face : back.faces) {
        for (const VertexId v : face.v) {
          REQUIRE(v <= next);
          next = std::max(next, VertexId(v + 1));
        }
      }
    }
  }
  CHECK(read(binary_stl(TriMesh{})).faces.empty());
  CHECK(read("solid\nendsolid\n").faces.empty());
}

TEST_CASE("0 and -0 are one position, and the next float is another") {
  const float next = std::nextafter(1.0f, 2.0f);
  const std::string head = "SOLID Two Triangles\n";
  const auto facet = [](const std::string& a) {
    return "facet normal 0 0 1 outer loop vertex " + a +
           " vertex 5 5 5 vertex 6 6 7 endloop endfacet\n";
  };
  CHECK(read(head + facet("0 -0 1") + facet("-0 0 1") + "endsolid").points.size() == 3);
  CHECK(read(head + facet("0 0 1") + facet(text("0 0 ", next)) + "endsolid").points.size() == 4);
  // Several solids are one mesh.
  CHECK(read(head + facet("0 0 1") + "endsolid a b\nsolid\n" + facet("1 1 1") + "EndSolid")
            .faces.size() == 2);
}

TEST_CASE("a facet that rounding has closed keeps its corners") {
  const TriMesh mesh =
      make_tri_mesh({{1, 0, 0}, {1 + 1e-12, 0, 0}, {0, 1, 0}}, Triangles{{0, 1, 2}});
  const TriMesh back = read(binary_stl(mesh));
  CHECK(back.points.size() == 2);
  REQUIRE(back.faces.size() == 1);
  CHECK(back.faces[0].v == Triangle{0, 0, 1});
}

TEST_CASE("comments: the writer's by itself, and what others have in the header") {
  using Comments = std::vector<std::string>;
  const std::string note = "deliso 0.1.0 max-distance=0.1 r-min=0.5 lambda=2";
  TriMesh mesh = mesh_of(tetrahedron());
  MeshNotes notes;
  read(binary_stl(mesh, note), &notes);
  CHECK(notes.comments == Comments{"binary STL by DelIso", note});
  mesh.frame.space = AnatomicalSpace::ras;
  read(binary_stl(mesh, note), &notes);
  CHECK(notes.comments == Comments{"binary STL by DelIso SPACE=RAS", note});
  read(binary_stl(mesh), &notes);
  CHECK(notes.comments == Comments{"binary STL by DelIso SPACE=RAS"});
  std::string bytes = binary_stl(mesh);
  bytes.replace(0, 80, "solid of another program" + std::string(56, '\0'));
  check_same_places(read(bytes, &notes), mesh);
  CHECK(notes.comments == Comments{"solid of another program"});
  read(stl_text(mesh), &notes);
  CHECK(notes.comments == Comments{"made by hand"});
}
