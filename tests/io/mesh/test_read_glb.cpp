// SPDX-License-Identifier: MIT
// Binary glTF: what write_mesh writes comes back where it was, and so do files of other programs.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "base/check.h"
#include "io/mesh/containers.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

TriMesh read_glb(const std::string& bytes, MeshNotes* notes = nullptr,
                 const ExpansionBudget& budget = {}) {
  return parse_mesh(bytes, MeshFormat::glb, "in", notes, budget);
}

}  // namespace

TEST_CASE("a written glTF comes back in the world, with its comment and its rounding") {
  for (const bool patient : {false, true}) {
    for (const bool values : {false, true}) {
      TriMesh mesh = random_sphere(3);
      mesh.frame.origin = {3000, -40000, 1e6};
      if (patient) mesh.frame.space = AnatomicalSpace::lps;
      MeshWriteOptions options = with_attributes(mesh, MeshFormat::glb);
      if (!values) options = {.format = MeshFormat::glb};
      options.comment = "deliso \"x\"";
      MeshNotes notes;
      const TriMesh read = read_glb(written(mesh, options), &notes);
      CHECK(notes.comments == std::vector<std::string>{options.comment});
      CHECK(notes.rounding > 0);
      CHECK(notes.rounding < 1e-4);
      REQUIRE(read.points.size() == mesh.points.size());
      const std::vector<Vec3> points = written_points(mesh, options);
      const Vec3 origin = written_origin(mesh, options);
      for (std::size_t v = 0; v < points.size(); ++v) {
        CHECK(distance(read.points[VertexId(v)], points[v] + origin) < (patient ? 1e-9 : 1e-10));
        CHECK(distance(read.points[VertexId(v)], mesh.frame.to_world(mesh.points[VertexId(v)])) <
              notes.rounding);
      }
      REQUIRE(read.faces.size() == mesh.faces.size());
      for (FaceId f = 0; f < mesh.faces.size(); ++f) CHECK(read.faces[f].v == mesh.faces[f].v);
    }
  }
  CHECK(read_glb(written(TriMesh{}, {.format = MeshFormat::glb})).points.empty());
}

TEST_CASE("glTF of another program: nested nodes, interleaved arrays, split vertices") {
  const auto [json, data] = rich_gltf();
  const TriMesh mesh = read_glb(glb_file(json, data));
  // Two squares side by side share two of their eight corners.
  REQUIRE(mesh.points.size() == 12);
  REQUIRE(mesh.faces.size() == 8);
  // The first copy is doubled, turned about z, and moved; then y is up: (x, y, z) is (x, -z, y).
  CHECK(distance(mesh.points[0], {10, 0, 0}) < 1e-12);
  CHECK(distance(mesh.points[1], {10, 0, 2}) < 1e-12);
  CHECK(distance(mesh.points[3], {8, 0, 0}) < 1e-12);
  CHECK(distance(mesh.points[4], {10, 0, 4}) < 1e-12);
  CHECK(mesh.faces[0].v == Triangle{0, 1, 2});
  CHECK(mesh.faces[2].v == Triangle{1, 4, 5});
  // The second one is mirrored, so its facets are reversed.
  CHECK(distance(mesh.points[7], {10, -5, -1}) < 1e-12);
  CHECK(mesh.faces[4].v == Triangle{6, 8, 7});
}

TEST_CASE("indices of every size, and none") {
  const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto file = [&](const std::string& indices, int type) {
    std::string json = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":TYPE,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":LENGTH}],
"buffers":[{"byteLength":100}]})";
    if (type == 0) json.erase(json.find(R"(,"indices":1)"), 12);
    json.replace(json.find("TYPE"), 4, std::to_string(type));
    json.replace(json.find("LENGTH"), 6, std::to_string(indices.size()));
    return read_glb(glb_file(json, bytes_of_numbers(corners) + indices));
  };
  for (const TriMesh& mesh :
       {file("", 0), file(bytes_of_numbers(std::vector<std::uint8_t>{0, 1, 2}), 5121),
        file(bytes_of_numbers(std::vector<std::uint16_t>{0, 1, 2}), 5123),
        file(bytes_of_numbers(std::vector<std::uint32_t>{0, 1, 2}), 5125)}) {
    CHECK(mesh.points == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    REQUIRE(mesh.faces.size() == 1);
    CHECK(mesh.faces[0].v == Triangle{0, 1, 2});
  }
}

TEST_CASE("a mesh that a small file places a million times does not fill the memory") {
  std::string nodes, roots;
  for (int n = 0; n < 200000; ++n) {
    nodes += R"({"mesh":0},)";
    roots += std::to_string(n) + ",";
  }
  nodes.pop_back();
  roots.pop_back();
  auto [json, data] = rich_gltf();
  json.replace(json.find("\"nodes\":[1]"), 11, "\"nodes\":[" + roots + "]");
  const std::size_t begin = json.find("\"nodes\":[{"), end = json.find("\"meshes\"");
  json.replace(begin, end - begin, "\"nodes\":[" + nodes + "],");
  CHECK_THROWS_WITH_AS(read_glb(glb_file(json, data), nullptr, {.free_bytes = 1 << 20, .ratio = 1}),
                       doctest::Contains("in memory"), InputError);
}

TEST_CASE("numbers that a small file uses many times do not fill the memory") {
  // Each primitive has the same vertices, or the same triangles, once more.
  const auto [json, data] = rich_gltf();
  const std::string key = "\"primitives\":[";
  const std::size_t begin = json.find(key) + key.size(), end = json.find(']', begin);
  REQUIRE(begin < end);
  std::string many = json.substr(begin, end - begin);
  for (int n = 0; n < 12; ++n) many += "," + many;
  std::string longer = json;
  longer.replace(begin, end - begin, many);
  const ExpansionBudget small{.free_bytes = 1000, .ratio = 0};
  CHECK_NOTHROW(read_glb(glb_file(longer, data)));
  CHECK_THROWS_WITH_AS(read_glb(glb_file(longer, data), nullptr, small),
                       doctest::Contains("in memory"), InputError);
}
