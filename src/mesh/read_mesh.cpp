// SPDX-License-Identifier: MIT
#include "mesh/read_mesh.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "mesh/mesh_parsers.h"

namespace deliso {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_all(const std::string& path) {
  const auto fail = [&path](int error) {
    throw InputError(text("cannot read '", path, "': ", std::generic_category().message(error)));
  };
  std::unique_ptr<std::FILE, CloseFile> opened;
  std::FILE* file = stdin;
  if (path != "-") {
    opened.reset(std::fopen(path.c_str(), "rb"));
    if (!opened) fail(errno);
    file = opened.get();
  }
  std::string bytes;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  for (std::size_t size = 0;; bytes.resize(size)) {
    bytes.resize(size + kBlock);
    const std::size_t count = std::fread(bytes.data() + size, 1, kBlock, file);
    size += count;
    if (count < kBlock) {
      if (std::ferror(file)) fail(errno);
      bytes.resize(size);
      return bytes;
    }
  }
}

MeshFormat format_of_bytes(std::string_view bytes) {
  const std::string_view word = take_word(bytes);
  if (word == "ply") return MeshFormat::ply;
  return word.ends_with("OFF") ? MeshFormat::off : MeshFormat::obj;
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 32;
  std::string shown = "'";
  for (const char c : word.substr(0, kMost)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (word.size() > kMost ? "...'" : "'");
}

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
  if (path != "-") {
    const MeshFormat format = mesh_format_of(path);
    return parse_mesh(read_all(path), format, path, comments);
  }
  const std::string bytes = read_all(path);
  return parse_mesh(bytes, format_of_bytes(bytes), "standard input", comments);
}

}  // namespace deliso
