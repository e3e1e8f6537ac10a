// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names the elements and their types, then the data.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/write_mesh.h"

namespace deliso {
namespace {

class PlyWriter {
 public:
  PlyWriter(AtomicFile& out, const MeshWriteOptions& options)
      : out_(out),
        options_(options),
        attributes_(options.attributes ? &*options.attributes : nullptr) {}

  void header(const WorldMesh& mesh);
  void vertex(std::size_t v, const Vec3& p);
  void facet(std::size_t f, const Triangle& t);

 private:
  // Writes a property; `last`: of its line.
  template <class T>
  void put(T value, bool last) {
    options_.ascii ? put_text(out_, value, last ? '\n' : ' ') : put_binary(out_, value);
  }

  AtomicFile& out_;
  const MeshWriteOptions& options_;
  const MeshAttributes* const attributes_;
};

void PlyWriter::header(const WorldMesh& mesh) {
  out_.write("ply\nformat ");
  out_.write(options_.ascii ? "ascii" : "binary_little_endian");
  out_.write(text(" 1.0\ncomment DelIso", mesh.space_note(), "\n"));
  const std::string comment = mesh.comment_line("", "");
  if (!comment.empty()) out_.write(text("comment ", comment, "\n"));
  out_.write(text("element vertex ", mesh.vertex_count(), "\n"));
  for (const char* axis : {"x", "y", "z"}) {
    out_.write(text("property ", options_.single_precision ? "float" : "double", " ", axis, "\n"));
  }
  if (attributes_) out_.write("property float nx\nproperty float ny\nproperty float nz\n");
  out_.write(text("element face ", mesh.face_count(), "\n"));
  out_.write("property list uchar int vertex_indices\n");
  if (attributes_) {
    out_.write("property int component\nproperty float distance\n");
    if (options_.first_cap) out_.write("property uchar cap\n");
  }
  if (!options_.sides.empty()) out_.write("property int label_front\nproperty int label_behind\n");
  out_.write("end_header\n");
}

void PlyWriter::vertex(std::size_t v, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool last = axis == 2 && !attributes_;
    options_.single_precision ? put(static_cast<float>(p[axis]), last) : put(p[axis], last);
  }
  if (!attributes_) return;
  const auto& [x, y, z] = attributes_->normals[v];
  put(x, false);
  put(y, false);
  put(z, true);
}

void PlyWriter::facet(std::size_t f, const Triangle& t) {
  put(std::uint8_t{3}, false);
  for (int i = 0; i < 3; ++i) put(t[i].number(), i == 2 && !attributes_ && options_.sides.empty());
  if (!options_.sides.empty()) {
    put(options_.sides[f][0], false);
    put(options_.sides[f][1], true);
  }
  if (!attributes_) return;
  put(attributes_->component[f], false);
  put(attributes_->distance[f], !options_.first_cap);
  if (options_.first_cap) put(std::uint8_t{f >= *options_.first_cap}, true);
}

}  // namespace

void write_ply(AtomicFile& out, std::span<const WorldMesh> objects) {
  const WorldMesh& mesh = objects.front();
  PlyWriter writer(out, mesh.options());
  writer.header(mesh);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) writer.vertex(v, mesh.point(v));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) writer.facet(f, mesh.triangle(f));
}

}  // namespace deliso
