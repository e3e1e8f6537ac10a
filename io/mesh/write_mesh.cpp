// SPDX-License-Identifier: MIT
#include "io/mesh/write_mesh.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "io/files/plain_text.h"
#include "io/files/text_scan.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/to_float.h"

namespace deliso {
namespace {

// The formats in the order of MeshFormat.
struct FormatRow {
  std::string_view ending;
  MeshWriter* write;
};
constexpr FormatRow kFormats[] = {
    {".ply", write_ply}, {".off", write_off},     {".obj", write_obj},
    {".stl", write_stl}, {".vtp", write_vtp},     {".glb", write_glb},
    {".3mf", write_3mf}, {".smesh", write_smesh}, {".poly", write_poly}};

bool has_ending_of(std::string_view path, MeshFormat format) {
  const std::string_view ending = kFormats[static_cast<std::size_t>(format)].ending;
  return path.size() > ending.size() && lower(path).ends_with(ending);
}

// `accepts(format)`: whether an ending will do.
template <class Accepts>
MeshFormat format_of(std::string_view path, const char* what, Accepts accepts) {
  std::string known;
  for (std::size_t n = 0; n < std::size(kFormats); ++n) {
    const auto format = static_cast<MeshFormat>(n);
    if (!accepts(format)) continue;
    if (has_ending_of(path, format)) return format;
    known += text(known.empty() ? "" : ", ", kFormats[n].ending);
  }
  throw InputError("'", path, "' has no ", what, " ending (", known, ")");
}

}  // namespace

MeshFormat mesh_format_of(std::string_view path) {
  return format_of(path, "mesh format's", [](MeshFormat) { return true; });
}

MeshFormat readable_format_of(std::string_view path) {
  return format_of(path, "readable mesh format's", is_read);
}

bool has_mesh_ending(std::string_view path) {
  for (std::size_t n = 0; n < std::size(kFormats); ++n) {
    const auto format = static_cast<MeshFormat>(n);
    if (is_read(format) && has_ending_of(path, format)) return true;
  }
  return false;
}

bool writes_single_precision(const MeshWriteOptions& options) {
  return options.single_precision || (options.format && is_always_single(*options.format));
}

WorldMesh::WorldMesh(const TriMesh& mesh, const MeshWriteOptions& options, std::string_view path)
    : mesh_(mesh),
      options_(options),
      mirrored_(mesh.frame.left_handed()),
      name_(plain_name(!options.name.empty() ? options.name
                       : path == "-"         ? "mesh"
                                             : std::filesystem::path(path).stem().string())),
      comment_(plain_comment(options.comment)) {}

bool WorldMesh::is_closed() const {
  return std::ranges::all_of(mesh_.faces, [](const Face& face) {
    return std::ranges::none_of(face.n, [](FaceId g) { return g == kNoId; });
  });
}

Vec3 written_origin(const TriMesh& mesh, const MeshWriteOptions& options) {
  return options.format == MeshFormat::glb ? glb_origin(WorldMesh(mesh, options)) : Vec3{};
}

std::vector<Vec3> written_points(const TriMesh& mesh, const MeshWriteOptions& options) {
  std::vector<Vec3> points = mesh.world_points();
  const bool single = writes_single_precision(options);
  const Vec3 origin = written_origin(mesh, options);
  for (Vec3& p : points) p = single ? to_float(p - origin) : p - origin;
  return points;
}

WrittenMesh written_mesh(const TriMesh& mesh, const MeshWriteOptions& options) {
  WrittenMesh written{written_points(mesh, options), {}};
  const WorldMesh world(mesh, options);
  written.triangles.reserve(world.face_count());
  for (std::size_t f = 0; f < world.face_count(); ++f) {
    written.triangles.push_back(world.triangle(f));
  }
  return written;
}

namespace {

// pre: one object, unless the format holds several.
void write_file(std::span<const WorldMesh> objects, const std::string& path) {
  const MeshWriteOptions& options = objects.front().options();
  const MeshFormat format = options.format ? *options.format
                            : path == "-"  ? MeshFormat::ply
                                           : mesh_format_of(path);
  DELISO_CHECK(objects.size() == 1 || holds_objects(format));
  AtomicFile out(path);
  kFormats[static_cast<std::size_t>(format)].write(out, objects);
  out.commit();
}

}  // namespace

void write_mesh(const TriMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  const WorldMesh world(mesh, options, path);
  write_file({&world, 1}, path);
}

void write_objects(std::span<const MeshObject> objects, const std::string& path) {
  std::vector<WorldMesh> worlds;
  for (const MeshObject& object : objects) worlds.emplace_back(object.mesh, object.options, path);
  write_file(worlds, path);
}

}  // namespace deliso
