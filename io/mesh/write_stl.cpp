// SPDX-License-Identifier: MIT
// Binary STL: 80 free bytes, the number of facets, then 50 bytes a facet: normal, three corners,
// two bytes unused.
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/text.h"
#include "base/triangle.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

void put_vector(AtomicFile& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) put_binary(out, static_cast<float>(p[axis]));
}

// Returns the unit normal; zero, as the format allows, if the triangle has none.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = area_normal(a, b, c);
  const double size = length(n);
  return size > 0 && std::isfinite(size) ? n / size : Vec3{};
}

}  // namespace

void write_stl(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& mesh = objects.front();
  if (mesh.face_count() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("cannot write '", out.path(), "': STL holds no ", mesh.face_count(),
                     " facets");
  }
  // Readers expect the ASCII kind in a file that begins with "solid".
  std::string header = std::string(kStlTitle) + mesh.space_note();
  const std::string comment = mesh.comment_line(" ", "");
  if (header.size() + comment.size() <= kStlHeader) header += comment;
  header.resize(kStlHeader, ' ');
  out.write(header);
  put_binary(out, static_cast<std::uint32_t>(mesh.face_count()));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 a = mesh.point(t[0]), b = mesh.point(t[1]), c = mesh.point(t[2]);
    put_vector(out, unit_normal(a, b, c));
    put_vector(out, a);
    put_vector(out, b);
    put_vector(out, c);
    put_binary(out, std::uint16_t{0});
  }
}

}  // namespace deliso
