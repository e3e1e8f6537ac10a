// SPDX-License-Identifier: MIT
// Files of several objects, each with a name, a label and a color.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "io/mesh/read_mesh.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::vector<MeshObject> three_objects(MeshFormat format, bool values) {
  std::vector<MeshObject> objects;
  for (const std::uint64_t seed : {1, 2, 3}) {
    TriMesh mesh = random_sphere(seed);
    MeshWriteOptions options = with_attributes(mesh, format);
    if (!values) options = {.format = format};
    options.name = "label <" + std::to_string(seed) + "> \"\xc3\xa4\xff\n\"";
    options.label = {-5 + static_cast<std::int64_t>(seed),
                     {255, 0, static_cast<std::uint8_t>(15 + seed)}};
    objects.push_back({std::move(mesh), std::move(options)});
  }
  objects.insert(objects.begin() + 1, {TriMesh{}, objects[0].options});  // a label without surface
  if (values) objects[1].options.attributes = MeshAttributes{};
  return objects;
}

}  // namespace

TEST_CASE("objects come back as one mesh, each with its own vertices") {
  const TemporaryFolder folder;
  for (const MeshFormat format : {MeshFormat::glb, MeshFormat::three_mf, MeshFormat::vtp}) {
    for (const bool values : {false, true}) {
      if (values && !holds_attributes(format)) continue;
      CAPTURE(static_cast<int>(format));
      const std::vector<MeshObject> objects = three_objects(format, values);
      write_objects(objects, folder / "objects");
      MeshNotes notes;
      const TriMesh read = parse_mesh(file_bytes(folder / "objects"), format, "in", &notes);
      REQUIRE(notes.colors.size() == read.faces.size());
      std::size_t v = 0, f = 0;
      for (const MeshObject& object : objects) {
        const std::size_t first = v;
        for (const Vec3& p : object.mesh.points) {
          REQUIRE(v < read.points.size());
          CHECK(distance(read.points[VertexId(v++)], p) < 1e-4);
        }
        for (const Face& face : object.mesh.faces) {
          REQUIRE(f < read.faces.size());
          if (!values)
            CHECK(notes.colors[f] == object.options.label->color);  // caps have their own
          const Triangle& t = read.faces[FaceId(f++)].v;
          for (int n = 0; n < 3; ++n) CHECK(t[n] == VertexId(first + std::size_t{face.v[n]}));
        }
      }
      CHECK(v == read.points.size());
      CHECK(f == read.faces.size());
    }
  }
}

TEST_CASE("every color comes back from glTF's linear ones, and objects without one are gray") {
  const TemporaryFolder folder;
  std::vector<MeshObject> objects;
  for (int n = 0; n < 256; ++n) {
    const auto byte = static_cast<std::uint8_t>(n);
    const std::array<std::uint8_t, 3> color{byte, static_cast<std::uint8_t>(255 - n), 7};
    objects.push_back({mesh_of(tetrahedron()), {.label = ObjectLabel{n, color}}});
  }
  for (const char* name : {"a.glb", "a.3mf", "a.vtp"}) {
    write_objects(objects, folder / name);
    MeshNotes notes;
    read_mesh(folder / name, &notes);
    for (std::size_t n = 0; n < objects.size(); ++n) {
      CHECK(notes.colors[4 * n] == objects[n].options.label->color);
    }
  }
  MeshNotes notes;
  write_mesh(mesh_of(tetrahedron()), folder / "one.3mf");
  read_mesh(folder / "one.3mf", &notes);
  CHECK(notes.colors.empty());
}

TEST_CASE("the labels of triangles' sides come back, polygons cut or not") {
  const TemporaryFolder folder;
  const TriMesh mesh = mesh_of(tetrahedron());
  MeshWriteOptions options{.sides = {{1, 0}, {-3, 2}, {7, -2147483647}, {0, 1}}};
  for (const char* name : {"a.ply", "a.vtp", "wide.vtp"}) {
    if (name[0] == 'w') options.sides[1] = {720575940621039145, 720575940621039146};
    write_mesh(mesh, folder / name, options);
    MeshNotes notes;
    read_mesh(folder / name, &notes);
    CHECK(notes.sides == options.sides);
    CHECK(notes.colors.empty());
  }
  const std::string square =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\nproperty int label_front\nproperty list uchar int vertex_indices\n"
      "property int label_behind\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "3 4 0 1 2 3 4\n5 3 0 1 2 6\n";
  MeshNotes notes;
  parse_mesh(square, MeshFormat::ply, "in", &notes);
  CHECK(notes.sides == std::vector<std::array<std::int64_t, 2>>{{3, 4}, {3, 4}, {5, 6}});
}

TEST_CASE("names and colors of objects") {
  const TemporaryFolder folder;
  const std::string glb = folder / "a.glb", vtp = folder / "a.vtp";
  write_objects(three_objects(MeshFormat::glb, true), glb);
  std::string bytes = file_bytes(glb);
  for (const int n : {1, 2, 3}) {
    // As node, as mesh, and as the material of its surface.
    const std::string name = "\"name\":\"label <" + std::to_string(n) + "> \\\"\xc3\xa4??\\\"\"";
    std::size_t count = 0;
    for (std::size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1))
      ++count;
    CHECK(count == 3);
  }
  CHECK(bytes.find("\"baseColorFactor\":[1,0,0.00354") != std::string::npos);

  write_objects(three_objects(MeshFormat::vtp, false), vtp);
  bytes = file_bytes(vtp);
  const TriMesh mesh = parse_mesh(bytes, MeshFormat::vtp, "in");
  CHECK(bytes.find(R"(<DataArray type="Int64" Name="label")") != std::string::npos);
  const std::string tag = R"(Name="color" NumberOfComponents="3" format="appended" offset=")";
  const std::size_t at = bytes.find(tag);
  REQUIRE(at != std::string::npos);
  const std::size_t data =
      bytes.find("\n_") + 2 + static_cast<std::size_t>(std::stoull(bytes.substr(at + tag.size())));
  CHECK(number_at<std::uint64_t>(bytes, data) == 3 * mesh.faces.size());
  CHECK(bytes.substr(data + 8, 6) == std::string("\xff\0\x10\xff\0\x10", 6));
  const std::size_t labels = data - 8 * mesh.faces.size();
  CHECK(number_at<std::uint64_t>(bytes, labels) == std::uint64_t(-4));
  CHECK(number_at<std::uint64_t>(bytes, data - 8) == std::uint64_t(-2));
}

TEST_CASE("one mesh has the name of its file, in glTF and 3MF") {
  const TemporaryFolder folder;
  const TriMesh mesh = mesh_of(tetrahedron());
  write_mesh(mesh, folder / "my \xc3\xa4 scan.v2.glb");
  CHECK(file_bytes(folder / "my \xc3\xa4 scan.v2.glb")
            .find("\"meshes\":[{\"name\":\"my \xc3\xa4 scan.v2\",") != std::string::npos);
  const auto name_in = [&](const std::string& name) {
    write_mesh(mesh, folder / "a", {.format = MeshFormat::glb, .name = name});
    const std::string bytes = file_bytes(folder / "a");
    const std::size_t at = bytes.find("\"nodes\":[{\"name\":\"") + 18;
    return bytes.substr(at, bytes.find('"', at) - at);
  };
  CHECK(name_in("") == "a");
  CHECK(name_in("b") == "b");
}
