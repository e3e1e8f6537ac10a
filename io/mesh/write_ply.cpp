// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names the elements and their types, then the data.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/mesh/label_numbers.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/write_mesh.h"

namespace deliso {
namespace {

std::string header(const WorldMesh& mesh, const LabelNumbers& numbers) {
  const MeshWriteOptions& options = mesh.options();
  std::string lines =
      text("ply\nformat ", options.ascii ? "ascii" : "binary_little_endian", " 1.0\ncomment DelIso",
           mesh.space_note(), "\n", mesh.comment_line("comment ", "\n"), numbers.lines("comment "),
           "element vertex ", mesh.vertex_count(), "\n");
  for (const char* axis : {"x", "y", "z"}) {
    lines += text("property ", options.single_precision ? "float" : "double", " ", axis, "\n");
  }
  if (options.attributes) lines += "property float nx\nproperty float ny\nproperty float nz\n";
  lines += text("element face ", mesh.face_count(), "\nproperty list uchar int vertex_indices\n");
  if (options.attributes) {
    lines += "property int component\nproperty float distance\n";
    if (options.first_cap) lines += "property uchar cap\n";
  }
  if (!options.sides.empty()) lines += "property int label_front\nproperty int label_behind\n";
  return lines + "end_header\n";
}

}  // namespace

void write_ply(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& mesh = objects.front();
  const MeshWriteOptions& options = mesh.options();
  const std::optional<MeshAttributes>& attributes = options.attributes;
  const LabelNumbers numbers(options);
  out.write(header(mesh, numbers));
  // Writes a property; `last`: of its line.
  const auto put = [&](auto value, bool last) {
    options.ascii ? put_text(out, value, last ? '\n' : ' ') : put_binary(out, value);
  };
  std::size_t vertex = 0;
  for_each_coordinate(mesh, [&](auto value, int axis) {
    put(value, axis == 2 && !attributes);
    if (axis < 2 || !attributes) return;
    const auto& [x, y, z] = attributes->normals[vertex++];
    put(x, false);
    put(y, false);
    put(z, true);
  });
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    put(std::uint8_t{3}, false);
    for (int i = 0; i < 3; ++i) put(t[i].number(), i == 2 && !attributes && options.sides.empty());
    if (!options.sides.empty()) {
      put(numbers(options.sides[f][0]), false);
      put(numbers(options.sides[f][1]), true);
    }
    if (!attributes) continue;
    put(attributes->component[f], false);
    put(attributes->distance[f], !options.first_cap);
    if (options.first_cap) put(std::uint8_t{f >= *options.first_cap}, true);
  }
}

}  // namespace deliso
