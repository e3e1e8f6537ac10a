// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names the elements and their types, then the data.
#include "base/text.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/ply_writer.h"

namespace deliso {

PlyWriter::PlyWriter(AtomicFile& out, const PlyHeader& header) : out_(out), header_(header) {
  out.write("ply\nformat ");
  out.write(header.ascii ? "ascii" : "binary_little_endian");
  out.write(" 1.0\n");
  for (const std::string& comment : header.comments) out.write(text("comment ", comment, "\n"));
  out.write(text("element vertex ", header.vertices, "\n"));
  for (const char* axis : {"x", "y", "z"}) {
    out.write(text("property ", header.single_precision ? "float" : "double", " ", axis, "\n"));
  }
  if (header.attributes) out.write("property float nx\nproperty float ny\nproperty float nz\n");
  out.write(text("element face ", header.facets, "\n"));
  out.write("property list uchar int vertex_indices\n");
  if (header.attributes) {
    out.write("property int component\nproperty float distance\n");
    if (header.first_cap) out.write("property uchar cap\n");
  }
  out.write("end_header\n");
}

template <class T>
void PlyWriter::put(T value, bool last) {
  header_.ascii ? put_text(out_, value, last ? '\n' : ' ') : put_binary(out_, value);
}

void PlyWriter::vertex(const Vec3& p) {
  const MeshAttributes* attributes = header_.attributes;
  for (int axis = 0; axis < 3; ++axis) {
    const bool last = axis == 2 && !attributes;
    header_.single_precision ? put(static_cast<float>(p[axis]), last) : put(p[axis], last);
  }
  if (!attributes) return;
  const auto& [x, y, z] = attributes->normals[next_vertex_++];
  put(x, false);
  put(y, false);
  put(z, true);
}

void PlyWriter::facet(const Triangle& t) {
  const MeshAttributes* attributes = header_.attributes;
  put(std::uint8_t{3}, false);
  for (int i = 0; i < 3; ++i) put(t[i].number(), i == 2 && !attributes);
  if (!attributes) return;
  const std::size_t f = next_facet_++;
  put(attributes->component[f], false);
  put(attributes->distance[f], !header_.first_cap);
  if (header_.first_cap) put(std::uint8_t{f >= *header_.first_cap}, true);
}

void write_ply(AtomicFile& out, const WorldMesh& mesh, const MeshWriteOptions& options) {
  PlyHeader header{{"DelIso" + mesh.space_note()},
                   mesh.vertex_count(),
                   mesh.face_count(),
                   options.single_precision,
                   options.ascii,
                   options.attributes ? &*options.attributes : nullptr,
                   options.first_cap};
  const std::string comment = mesh.comment_line("", "");
  if (!comment.empty()) header.comments.push_back(comment);
  PlyWriter writer(out, header);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) writer.vertex(mesh.point(v));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) writer.facet(mesh.triangle(f));
}

}  // namespace deliso
