// SPDX-License-Identifier: MIT
// glTF 2.0, binary: a head of 12 bytes, JSON that describes the arrays, then the arrays. Every
// number of an array has 4 bytes, so that all are aligned.
//
// glTF has single precision, the meter, and y up. So coordinates are relative to the mesh's middle,
// and the node's matrix adds the middle and turns z up into y up. Where the world is a patient's,
// its unit is the millimeter, and the matrix scales it.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/box3.h"
#include "base/check.h"
#include "base/text.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/to_float.h"

namespace deliso {
namespace {

// Numbers of the specification.
constexpr std::uint32_t kVersion = 2;
constexpr int kFloat = 5126, kUnsigned = 5125, kVertexArray = 34962, kIndexArray = 34963;
constexpr std::uint64_t kWord = 4;  // bytes of a number

Box3 box_of_points(const WorldMesh& mesh) {
  if (mesh.vertex_count() == 0) return {};
  Box3 box{mesh.point(0), mesh.point(0)};
  for (std::size_t v = 1; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.point(v);
    box = united(box, {p, p});
  }
  return box;
}

Vec3 middle_of(const Box3& box) {
  return to_float(0.5 * box.lo + 0.5 * box.hi);
}

// One array of the file, which is a view of the buffer and an accessor.
struct Array {
  std::uint64_t count, words_each;
  bool holds_indices = false;
  std::string range{};  // of coordinates
  std::uint64_t bytes() const { return count * words_each * kWord; }
};

// The members of the JSON that list things, without their brackets.
struct Scene {
  std::string roots, nodes, meshes, materials;
  std::size_t node_count = 0, material_count = 0;
  std::vector<Array> arrays;
};

std::string quoted(std::string_view words) {
  std::string result = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string list(const Vec3& p) {
  return text("[", p.x, ",", p.y, ",", p.z, "]");
}

// Returns the members "buffers", "bufferViews" and "accessors".
std::string arrays_json(const std::vector<Array>& arrays) {
  std::string views, accessors;
  std::uint64_t at = 0;
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    const Array& a = arrays[n];
    const char* comma = n == 0 ? "" : ",";
    views += text(comma, R"({"buffer":0,"byteOffset":)", at, R"(,"byteLength":)", a.bytes(),
                  R"(,"target":)", a.holds_indices ? kIndexArray : kVertexArray, "}");
    accessors += text(comma, R"({"bufferView":)", n, R"(,"componentType":)",
                      a.holds_indices ? kUnsigned : kFloat, R"(,"count":)", a.count, R"(,"type":")",
                      a.words_each == 3 ? "VEC3" : "SCALAR", "\"", a.range, "}");
    at += a.bytes();
  }
  return text(R"("buffers":[{"byteLength":)", at, R"(}],"bufferViews":[)", views,
              R"(],"accessors":[)", accessors, "]");
}

std::string name_json(const WorldMesh& mesh) {
  return text(R"("name":)", quoted(mesh.name()), ",");
}

// Returns a node of the n-th mesh.
std::string node_json(const WorldMesh& mesh, std::size_t n, const Vec3& middle) {
  const double s = mesh.space().empty() ? 1 : kMeters;
  // By columns. x, y, z of the world are x, -z, y of glTF.
  return text("{", name_json(mesh), R"("mesh":)", n, R"(,"matrix":[)", s, ",0,0,0,0,0,", -s,
              ",0,0,", s, ",0,0,", s * middle.x, ",", s * middle.z, ",", -s * middle.y, ",1]}");
}

std::string material_json(std::string_view name, const std::string& color) {
  return text(R"({"name":)", quoted(name), R"(,"doubleSided":true,"pbrMetallicRoughness":{)",
              R"("baseColorFactor":[)", color, R"(,1],"metallicFactor":0,"roughnessFactor":0.8}})");
}

std::string linear_color(const std::array<std::uint8_t, 3>& srgb) {
  std::string color;
  for (const std::uint8_t byte : srgb) {
    color += text(color.empty() ? "" : ",", linear_of(byte));
  }
  return color;
}

// Adds the node, the mesh, its arrays, and its materials. A mesh without facets is not allowed.
void add_object(Scene& scene, const WorldMesh& mesh, const Vec3& middle, const Box3& box) {
  const MeshWriteOptions& options = mesh.options();
  const std::size_t vertices = mesh.vertex_count(), facets = mesh.face_count();
  const std::size_t surface = options.attributes ? options.first_cap.value_or(facets) : facets;
  std::vector<Array>& arrays = scene.arrays;
  const std::size_t first = arrays.size();
  // Rounding is monotone, so the least coordinate is the rounded least.
  arrays.push_back({vertices, 3, false,
                    text(R"(,"min":)", list(to_float(box.lo - middle)), R"(,"max":)",
                         list(to_float(box.hi - middle)))});
  std::string values = text(R"("POSITION":)", first);
  if (options.attributes) {
    arrays.insert(arrays.end(), {{vertices, 3}, {vertices, 1}, {vertices, 1}});
    values += text(R"(,"NORMAL":)", first + 1, R"(,"_COMPONENT":)", first + 2, R"(,"_DISTANCE":)",
                   first + 3);
  }
  std::string primitives;
  const auto add_primitive = [&](std::size_t size, std::string_view name,
                                 const std::string& color) {
    if (size == 0) return;
    primitives +=
        text(primitives.empty() ? "" : ",", R"({"attributes":{)", values, R"(},"indices":)",
             arrays.size(), R"(,"material":)", scene.material_count, "}");
    scene.materials += text(scene.material_count++ == 0 ? "" : ",", material_json(name, color));
    arrays.push_back({3 * size, 1, true});
  };
  const std::vector<MeshWriteOptions::Group>& groups = options.groups;
  for (std::size_t n = 0; n < groups.size(); ++n) {
    const std::size_t end = n + 1 < groups.size() ? groups[n + 1].first : facets;
    add_primitive(end - groups[n].first, groups[n].name, linear_color(groups[n].color));
  }
  if (groups.empty()) {
    add_primitive(surface, options.label ? mesh.name() : "surface",
                  options.label ? linear_color(options.label->color) : "0.8,0.8,0.8");
    add_primitive(facets - surface, "cap", "0.9,0.6,0.3");
  }
  const char* const comma = scene.node_count == 0 ? "" : ",";
  scene.roots += text(comma, scene.node_count);
  scene.nodes += comma + node_json(mesh, scene.node_count, middle);
  scene.meshes += text(comma, "{", name_json(mesh), R"("primitives":[)", primitives, "]}");
  ++scene.node_count;
}

std::string asset_json(const WorldMesh& mesh) {
  const std::string space(mesh.space());
  return text(R"("asset":{"version":"2.0","generator":"DelIso","extras":{"comment":)",
              quoted(mesh.comment_line("", "")), space.empty() ? "" : R"(,"SPACE":)",
              space.empty() ? "" : quoted(space), "}}");
}

// Writes the component of every vertex, then the largest distance of its facets.
void put_values(AtomicFile& out, const WorldMesh& mesh, const MeshAttributes& attributes) {
  std::vector<float> component(mesh.vertex_count(), 0), distance(mesh.vertex_count(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const VertexId v : mesh.triangle(f)) {
      component[v] = static_cast<float>(attributes.component[f]);
      distance[v] = std::max(distance[v], attributes.distance[f]);
    }
  }
  for (const float value : component) put_binary(out, value);
  for (const float value : distance) put_binary(out, value);
}

void put_object(AtomicFile& out, const WorldMesh& mesh, const Vec3& middle) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.point(v) - middle;
    for (int axis = 0; axis < 3; ++axis) put_binary(out, static_cast<float>(p[axis]));
  }
  if (const auto& attributes = mesh.options().attributes) {
    for (const auto& normal : attributes->normals) {
      for (const float x : normal) put_binary(out, x);
    }
    put_values(out, mesh, *attributes);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const VertexId v : mesh.triangle(f)) put_binary(out, v.number());
  }
}

}  // namespace

Vec3 glb_origin(const WorldMesh& mesh) {
  return middle_of(box_of_points(mesh));
}

void write_glb(AtomicFile& out, std::span<const WorldMesh> objects) {
  Scene scene;
  std::vector<Vec3> middles;
  for (const WorldMesh& mesh : objects) {
    const Box3 box = box_of_points(mesh);
    middles.push_back(middle_of(box));
    if (mesh.face_count() > 0) add_object(scene, mesh, middles.back(), box);
  }
  const bool empty = scene.node_count == 0;
  std::string json = text("{", asset_json(objects.front()), R"(,"scene":0,"scenes":[{)");
  json += empty ? "}]}"
                : text(R"("nodes":[)", scene.roots, R"(]}],"nodes":[)", scene.nodes,
                       R"(],"meshes":[)", scene.meshes, R"(],"materials":[)", scene.materials, "],",
                       arrays_json(scene.arrays), "}");
  json.resize((json.size() + kWord - 1) / kWord * kWord, ' ');
  std::uint64_t binary_bytes = 0;
  for (const Array& a : scene.arrays) binary_bytes += a.bytes();
  constexpr std::uint64_t kHead = 12, kChunkHead = 8;
  const std::uint64_t all =
      kHead + kChunkHead + json.size() + (empty ? 0 : kChunkHead + binary_bytes);
  if (all > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("cannot write '", out.path(), "': glTF holds no more than 4 GiB");
  }
  const auto put_number = [&](std::uint64_t n) { put_binary(out, static_cast<std::uint32_t>(n)); };
  put_number(kGlbMagic);
  put_number(kVersion);
  put_number(all);
  put_number(json.size());
  put_number(kGlbJson);
  out.write(json);
  if (empty) return;
  put_number(binary_bytes);
  put_number(kGlbBinary);
  for (std::size_t n = 0; n < objects.size(); ++n) {
    if (objects[n].face_count() > 0) put_object(out, objects[n], middles[n]);
  }
}

}  // namespace deliso
