// SPDX-License-Identifier: MIT
#include "mesh/read_mesh.h"

#include <utility>

#include "files/input_file.h"
#include "mesh/mesh_parsers.h"

namespace deliso {
namespace {

MeshFormat format_of_bytes(std::string_view bytes) {
  const std::string_view word = take_word(bytes);
  if (word == "ply") return MeshFormat::ply;
  return word.ends_with("OFF") ? MeshFormat::off : MeshFormat::obj;
}

}  // namespace

TriMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name,
                   std::vector<std::string>* comments) {
  MeshParts parts;
  switch (format) {
    case MeshFormat::ply:
      parts = parse_ply(bytes, name);
      break;
    case MeshFormat::off:
      parts = parse_off(bytes, name);
      break;
    case MeshFormat::obj:
      parts = parse_obj(bytes, name);
      break;
    case MeshFormat::stl:
    case MeshFormat::vtp:
      throw InputError(text("'", name, "': meshes are read from .ply, .off and .obj alone"));
  }
  if (parts.points.size() > kMostVertices || parts.triangles.size() > kMostFaces) {
    throw InputError(text("'", name, "': more vertices or facets than 32-bit ids can name"));
  }
  if (comments != nullptr) *comments = std::move(parts.comments);
  return make_tri_mesh(std::move(parts.points), parts.triangles);
}

TriMesh read_mesh(const std::string& path, std::vector<std::string>* comments) {
  if (path == "-") {
    const Bytes bytes = read_standard_input();
    return parse_mesh(bytes.text(), format_of_bytes(bytes.text()), bytes.name, comments);
  }
  const MeshFormat format = mesh_format_of(path);
  return parse_mesh(open_file(path).text(), format, path, comments);
}

}  // namespace deliso
