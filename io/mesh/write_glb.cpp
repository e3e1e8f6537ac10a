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
#include "base/to_float.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

// Numbers of the specification.
constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2, kJson = 0x4e4f534a, kBinary = 0x004e4942;
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
  std::string range;  // of coordinates
};

std::string list(const Vec3& p) {
  return text("[", p.x, ",", p.y, ",", p.z, "]");
}

// Returns the members "buffers", "bufferViews" and "accessors". The arrays from `indices` on hold
// indices.
std::string arrays_json(const std::vector<Array>& arrays, std::size_t indices) {
  std::string views, accessors;
  std::uint64_t at = 0;
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    const Array& a = arrays[n];
    const char* comma = n == 0 ? "" : ",";
    const std::uint64_t bytes = a.count * a.words_each * kWord;
    views += text(comma, R"({"buffer":0,"byteOffset":)", at, R"(,"byteLength":)", bytes,
                  R"(,"target":)", n < indices ? kVertexArray : kIndexArray, "}");
    accessors += text(comma, R"({"bufferView":)", n, R"(,"componentType":)",
                      n < indices ? kFloat : kUnsigned, R"(,"count":)", a.count, R"(,"type":")",
                      a.words_each == 3 ? "VEC3" : "SCALAR", "\"", a.range, "}");
    at += bytes;
  }
  return text(R"("buffers":[{"byteLength":)", at, R"(}],"bufferViews":[)", views,
              R"(],"accessors":[)", accessors, "]");
}

// Returns the member "nodes", whose one node has mesh 0.
std::string node_json(const Vec3& middle, bool is_millimeters) {
  const double s = is_millimeters ? 0.001 : 1;
  // By columns. x, y, z of the world are x, -z, y of glTF.
  return text(R"("nodes":[{"mesh":0,"matrix":[)", s, ",0,0,0,0,0,", -s, ",0,0,", s, ",0,0,",
              s * middle.x, ",", s * middle.z, ",", -s * middle.y, ",1]}]");
}

std::string material_json(const char* name, const char* color) {
  return text(R"({"name":")", name, R"(","doubleSided":true,"pbrMetallicRoughness":{)",
              R"("baseColorFactor":)", color, R"(,"metallicFactor":0,"roughnessFactor":0.8}})");
}

std::string asset_json(const WorldMesh& mesh) {
  std::string comment;
  for (const char c : mesh.comment_line("", "")) {
    if (c == '"') comment += '\\';
    comment += c;
  }
  const std::string_view space = mesh.space();
  return text(R"("asset":{"version":"2.0","generator":"DelIso","extras":{"comment":")", comment,
              space.empty() ? "" : R"(","SPACE":")", space, "\"}}");
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

}  // namespace

Vec3 glb_origin(const WorldMesh& mesh) {
  return middle_of(box_of_points(mesh));
}

void write_glb(AtomicFile& out, const WorldMesh& mesh, const MeshWriteOptions& options) {
  const Box3 box = box_of_points(mesh);
  const Vec3 middle = middle_of(box);
  const std::size_t vertices = mesh.vertex_count(), facets = mesh.face_count();
  const std::size_t surface = options.attributes ? options.first_cap.value_or(facets) : facets;

  std::vector<Array> arrays;
  // Rounding is monotone, so the least coordinate is the rounded least.
  arrays.push_back({vertices, 3,
                    text(R"(,"min":)", list(to_float(box.lo - middle)), R"(,"max":)",
                         list(to_float(box.hi - middle)))});
  if (options.attributes)
    arrays.insert(arrays.end(), {{vertices, 3, ""}, {vertices, 1, ""}, {vertices, 1, ""}});
  const std::size_t indices = arrays.size();
  const char* const values =
      options.attributes ? R"(,"NORMAL":1,"_COMPONENT":2,"_DISTANCE":3)" : "";
  std::string primitives;
  const auto add_primitive = [&](std::size_t size, int material) {
    if (size == 0) return;
    primitives += text(primitives.empty() ? "" : ",", R"({"attributes":{"POSITION":0)", values,
                       R"(},"indices":)", arrays.size(), R"(,"material":)", material, "}");
    arrays.push_back({3 * size, 1, ""});
  };
  add_primitive(surface, 0);
  add_primitive(facets - surface, 1);

  // A mesh without facets is not allowed.
  std::string json = text("{", asset_json(mesh), R"(,"scene":0,"scenes":[{)");
  if (facets > 0) {
    append_text(json, text(R"("nodes":[0]}],)", node_json(middle, !mesh.space().empty()),
                           R"(,"meshes":[{"primitives":[)", primitives, R"(]}],"materials":[)",
                           material_json("surface", "[0.8,0.8,0.8,1]")));
    if (surface < facets) {
      append_text(json, text(",", material_json("cap", "[0.9,0.6,0.3,1]")));
    }
    append_text(json, text("],", arrays_json(arrays, indices), "}"));
  } else {
    append_text(json, "}]}");
    arrays.clear();
  }
  json.resize((json.size() + kWord - 1) / kWord * kWord, ' ');
  std::uint64_t binary_bytes = 0;
  for (const Array& a : arrays) binary_bytes += a.count * a.words_each * kWord;
  constexpr std::uint64_t kHead = 12, kChunkHead = 8;
  const std::uint64_t all =
      kHead + kChunkHead + json.size() + (facets > 0 ? kChunkHead + binary_bytes : 0);
  if (all > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(text("cannot write '", out.path(), "': glTF holds no more than 4 GiB"));
  }
  const auto put_number = [&](std::uint64_t n) { put_binary(out, static_cast<std::uint32_t>(n)); };
  put_number(kMagic);
  put_number(kVersion);
  put_number(all);
  put_number(json.size());
  put_number(kJson);
  out.write(json);
  if (facets == 0) return;
  put_number(binary_bytes);
  put_number(kBinary);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3 p = mesh.point(v) - middle;
    for (int axis = 0; axis < 3; ++axis) put_binary(out, static_cast<float>(p[axis]));
  }
  if (options.attributes) {
    for (const auto& normal : options.attributes->normals) {
      for (const float x : normal) put_binary(out, x);
    }
    put_values(out, mesh, *options.attributes);
  }
  for (std::size_t f = 0; f < facets; ++f) {
    for (const VertexId v : mesh.triangle(f)) put_binary(out, v.number());
  }
}

}  // namespace deliso
