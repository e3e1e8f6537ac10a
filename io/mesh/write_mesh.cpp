// SPDX-License-Identifier: MIT
#include "io/mesh/write_mesh.h"

#include "base/check.h"
#include "base/text.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

struct Ending {
  std::string_view text;
  MeshFormat format;
};
constexpr Ending kEndings[] = {{".ply", MeshFormat::ply},
                               {".off", MeshFormat::off},
                               {".obj", MeshFormat::obj},
                               {".stl", MeshFormat::stl},
                               {".vtp", MeshFormat::vtp}};

bool ends_with(std::string_view path, std::string_view ending) {
  if (path.size() <= ending.size()) return false;
  path.remove_prefix(path.size() - ending.size());
  for (std::size_t i = 0; i < ending.size(); ++i) {
    const char c = path[i];
    if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != ending[i]) return false;
  }
  return true;
}

// Returns a comment that every format allows.
std::string clean(std::string comment) {
  for (std::size_t i = 0; i < comment.size(); ++i) {
    const char c = comment[i];
    const bool twice = c == '-' && i > 0 && comment[i - 1] == '-';
    if (c < ' ' || c > '~' || c == '\\' || twice) comment[i] = '?';
  }
  return comment;
}

}  // namespace

MeshFormat mesh_format_of(std::string_view path) {
  std::string known;
  for (const Ending& ending : kEndings) {
    if (ends_with(path, ending.text)) return ending.format;
    known += text(known.empty() ? "" : ", ", ending.text);
  }
  throw InputError(text("'", path, "' has no mesh format's ending (", known, ")"));
}

bool writes_single_precision(const MeshWriteOptions& options) {
  return options.single_precision || options.format == MeshFormat::stl;
}

std::vector<Vec3> written_points(const TriMesh& mesh, const MeshWriteOptions& options) {
  std::vector<Vec3> points = mesh.world_points();
  const bool single = writes_single_precision(options);
  for (Vec3& p : points) {
    for (int axis = 0; single && axis < 3; ++axis) p[axis] = static_cast<float>(p[axis]);
  }
  return points;
}

PartMesh written_part(const TriMesh& mesh, const MeshWriteOptions& options) {
  PartMesh part{written_points(mesh, options), {}, options.seam};
  const WorldMesh world(mesh, {});
  part.triangles.reserve(world.face_count());
  for (std::size_t f = 0; f < world.face_count(); ++f) part.triangles.push_back(world.triangle(f));
  return part;
}

void write_mesh(const TriMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  const MeshFormat format = options.format ? *options.format
                            : path == "-"  ? MeshFormat::ply
                                           : mesh_format_of(path);
  const WorldMesh world(mesh, clean(options.comment));
  AtomicFile out(path, options.sync);
  switch (format) {
    case MeshFormat::ply:
      write_ply(out, world, options);
      break;
    case MeshFormat::off:
      write_off(out, world, options.single_precision);
      break;
    case MeshFormat::obj:
      write_obj(out, world, options.single_precision);
      break;
    case MeshFormat::stl:
      write_stl(out, world);
      break;
    case MeshFormat::vtp:
      write_vtp(out, world, options.single_precision);
      break;
  }
  out.commit();
}

}  // namespace deliso
