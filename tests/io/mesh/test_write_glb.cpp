// SPDX-License-Identifier: MIT
// glTF files against the specification's demands.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/files/json_value.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

const JsonValue& member(const JsonValue& object, const std::string& key) {
  REQUIRE_MESSAGE(!object[key].is_null(), key);
  return object[key];
}

std::size_t count(const JsonValue& object, const std::string& key) {
  const double number = member(object, key).number;
  REQUIRE(number >= 0);
  REQUIRE(number == std::floor(number));
  return static_cast<std::size_t>(number);
}

struct Glb {
  JsonValue json;
  std::string buffer;

  const JsonValue& item(const std::string& list, std::size_t n) const {
    const std::vector<JsonValue>& items = member(json, list).items;
    REQUIRE(n < items.size());
    return items[n];
  }
  // The numbers of an accessor, and the least and the largest of each component.
  template <class T>
  std::vector<T> numbers(std::size_t accessor) const {
    const JsonValue& a = item("accessors", accessor);
    const JsonValue& view = item("bufferViews", count(a, "bufferView"));
    const std::size_t at = count(view, "byteOffset"),
                      width = member(a, "type").string == "VEC3" ? 3 : 1;
    CHECK(member(a, "componentType").number == (std::is_same_v<T, float> ? 5126 : 5125));
    CHECK(member(view, "target").number == (std::is_same_v<T, float> ? 34962 : 34963));
    CHECK(at % 4 == 0);
    CHECK(count(a, "count") >= 1);
    CHECK(count(view, "byteLength") == 4 * width * count(a, "count"));
    CHECK(at + count(view, "byteLength") <= buffer.size());
    std::vector<T> all;
    for (std::size_t n = 0; n < width * count(a, "count"); ++n) {
      all.push_back(number_at<T>(buffer, at + 4 * n));
    }
    return all;
  }
};

Glb parsed(const std::string& bytes) {
  CHECK(bytes.substr(0, 4) == "glTF");
  CHECK(number_at<std::uint32_t>(bytes, 4) == 2);
  CHECK(number_at<std::uint32_t>(bytes, 8) == bytes.size());
  const std::size_t text = number_at<std::uint32_t>(bytes, 12);
  CHECK(text % 4 == 0);
  CHECK(bytes.substr(16, 4) == "JSON");
  Glb glb{parse_json(bytes.substr(20, text), "glTF"), {}};
  CHECK(member(member(glb.json, "asset"), "version").string == "2.0");
  if (bytes.size() == 20 + text) return glb;
  const std::size_t size = number_at<std::uint32_t>(bytes, 20 + text);
  CHECK(size % 4 == 0);
  CHECK(bytes.substr(24 + text, 4) == std::string("BIN\0", 4));
  glb.buffer = bytes.substr(28 + text);
  CHECK(glb.buffer.size() == size);
  CHECK(count(glb.item("buffers", 0), "byteLength") == size);
  std::size_t end = 0;  // of the views, which follow each other
  for (const JsonValue& view : member(glb.json, "bufferViews").items) {
    CHECK(count(view, "byteOffset") == end);
    end += count(view, "byteLength");
  }
  CHECK(end == size);
  return glb;
}

}  // namespace

// test_read_glb.cpp has the vertices and facets.
TEST_CASE("glTF: its extras, the bounds of its coordinates, and a matrix to the world") {
  for (const bool patient : {false, true}) {
    TriMesh mesh = random_sphere(11);
    mesh.frame.origin = {3000, -40000, 1e6};
    if (patient) mesh.frame.space = AnatomicalSpace::lps;
    const MeshWriteOptions options{.format = MeshFormat::glb, .comment = "a \"quoted\" word"};
    const Glb glb = parsed(written(mesh, options));
    const JsonValue& extras = member(member(glb.json, "asset"), "extras");
    CHECK(member(extras, "comment").string == options.comment);
    CHECK(extras["SPACE"].is_null() != patient);
    CHECK(member(glb.item("scenes", count(glb.json, "scene")), "nodes").items[0].number == 0);
    const std::vector<JsonValue>& matrix = member(glb.item("nodes", 0), "matrix").items;
    REQUIRE(matrix.size() == 16);
    // z is up in the world, y in glTF, whose unit is the meter.
    const double unit = patient ? 0.001 : 1;
    const double turned[] = {unit, 0, 0, 0, 0, 0, -unit, 0, 0, unit, 0, 0};
    for (std::size_t n = 0; n < 12; ++n) CHECK(matrix[n].number == turned[n]);
    CHECK(matrix[15].number == 1);
    const auto& primitives = member(glb.item("meshes", 0), "primitives").items;
    REQUIRE(primitives.size() == 1);
    CHECK(count(primitives[0], "material") < member(glb.json, "materials").items.size());
    CHECK(glb.numbers<std::uint32_t>(count(primitives[0], "indices")).size() ==
          3 * mesh.faces.size());
    const JsonValue& names = member(primitives[0], "attributes");
    CHECK(names.keys.size() == 1);

    const std::size_t accessor = count(names, "POSITION");
    const std::vector<float> positions = glb.numbers<float>(accessor);
    REQUIRE(positions.size() == 3 * mesh.points.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float least = positions[axis], largest = least;
      for (std::size_t n = axis; n < positions.size(); n += 3) {
        least = std::min(least, positions[n]);
        largest = std::max(largest, positions[n]);
      }
      CHECK(member(glb.item("accessors", accessor), "min").items[axis].number == least);
      CHECK(member(glb.item("accessors", accessor), "max").items[axis].number == largest);
    }
  }
}

TEST_CASE("glTF: values of vertices, and caps as a primitive of their own") {
  const TriMesh mesh = mesh_of(tetrahedron());
  MeshWriteOptions options = with_attributes(mesh, MeshFormat::glb);
  for (const std::size_t first_cap : {3, 0, 4}) {
    options.first_cap = first_cap;
    const Glb glb = parsed(written(mesh, options));
    std::vector<std::uint32_t> corners;
    for (const JsonValue& primitive : member(glb.item("meshes", 0), "primitives").items) {
      const std::string material =
          member(glb.item("materials", count(primitive, "material")), "name").string;
      CHECK(material == (corners.size() < 3 * first_cap ? "surface" : "cap"));
      for (const std::uint32_t v : glb.numbers<std::uint32_t>(count(primitive, "indices"))) {
        corners.push_back(v);
      }
      const JsonValue& names = member(primitive, "attributes");
      const auto normals = glb.numbers<float>(count(names, "NORMAL"));
      REQUIRE(normals.size() == 12);
      for (std::size_t n = 0; n < normals.size(); ++n) {
        CHECK(normals[n] == options.attributes->normals[n / 3][n % 3]);
      }
      // Facets: 0 2 1, 0 1 3, 1 2 3, 2 0 3.
      CHECK(glb.numbers<float>(count(names, "_DISTANCE")) ==
            std::vector<float>{0.1f * 3, 0.1f * 2, 0.1f * 3, 0.1f * 3});
      CHECK(glb.numbers<float>(count(names, "_COMPONENT")) == std::vector<float>{1, 1, 1, 1});
    }
    REQUIRE(corners.size() == 12);
    for (std::size_t n = 0; n < 12; ++n) CHECK(corners[n] == mesh.faces[FaceId(n / 3)].v[n % 3]);
  }
}

TEST_CASE("glTF of an empty mesh has a scene without nodes") {
  const Glb glb = parsed(written(TriMesh{}, {.format = MeshFormat::glb}));
  CHECK(glb.buffer.empty());
  CHECK(glb.json["meshes"].is_null());
  CHECK(member(glb.json, "scenes").items.size() == 1);
}
