// SPDX-License-Identifier: MIT
#include "io/mesh/read_mesh.h"

#include <cmath>
#include <utility>

#include "io/files/input_file.h"
#include "io/files/vtk_xml.h"
#include "io/files/zip_archive.h"
#include "io/mesh/mesh_parsers.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

MeshFormat format_of_bytes(std::string_view bytes) {
  const std::string_view all = bytes;
  const std::string_view word = take_word(bytes);
  if (word == "ply") return MeshFormat::ply;
  if (word.ends_with("OFF")) return MeshFormat::off;
  if (all.starts_with("glTF")) return MeshFormat::glb;
  if (looks_like_zip(all)) return MeshFormat::three_mf;
  if (word == "solid" || looks_like_binary_stl(all)) return MeshFormat::stl;
  return looks_like_vtk_xml(all) ? MeshFormat::vtp : MeshFormat::obj;
}

// Throws unless all points are in the predicates' range. `first`: the format's first vertex number.
void require_in_range(const std::vector<Vec3>& points, const std::string& name, std::size_t first) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (int axis = 0; axis < 3 && !in_range(points[v]); ++axis) {
      const double x = points[v][axis];
      if (std::fabs(x) <= kLargestLength) continue;
      fail(name, "coordinate ", "xyz"[axis], " of vertex ", first + v, " is ", x,
           ", not a number up to ", kLargestLength, " in size");
    }
  }
}

// Returns the space that comments name as those of write_mesh do, and of 3D Slicer.
AnatomicalSpace space_in(const std::vector<std::string>& comments) {
  constexpr std::string_view kMark = "SPACE=";
  for (const std::string_view comment : comments) {
    for (const std::string_view word : words_of(comment)) {
      if (word.starts_with(kMark)) return space_named(word.substr(kMark.size()));
    }
  }
  return AnatomicalSpace::unknown;
}

// In the order of MeshFormat.
constexpr MeshParser* kParsers[] = {parse_ply, parse_off, parse_obj, parse_stl,
                                    parse_vtp, parse_glb, parse_3mf};

}  // namespace

std::vector<VertexId> merge_points(std::vector<Vec3>& points) {
  std::vector<VertexId> number = first_at_place(points);  // the loop replaces it by the new number
  std::size_t kept = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (number[n] < n) {
      number[n] = number[number[n]];
    } else {
      number[n] = VertexId(kept);
      points[kept++] = points[n];
    }
  }
  points.resize(kept);
  return number;
}

TriMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name,
                   MeshNotes* notes, const ExpansionBudget& budget) {
  DELISO_CHECK(is_read(format));
  const std::string quoted = text("'", name, "'");
  MeshParts parts = kParsers[static_cast<std::size_t>(format)](bytes, quoted, budget);
  if (parts.points.size() > kMostVertices || parts.triangles.size() > kMostFaces) {
    fail(quoted, "more vertices or facets than 32-bit ids can name");
  }
  require_in_range(parts.points, quoted, format == MeshFormat::obj ? 1 : 0);
  TriMesh mesh = make_tri_mesh(std::move(parts.points), parts.triangles);
  const bool by_comment = parts.space == AnatomicalSpace::unknown;
  mesh.frame.space = by_comment ? space_in(parts.comments) : parts.space;
  if (notes) {
    *notes = {std::move(parts.comments), parts.rounding, std::move(parts.colors),
              std::move(parts.sides)};
  }
  return mesh;
}

TriMesh read_mesh(const std::string& path, MeshNotes* notes) {
  if (path == "-") {
    const Bytes bytes = read_standard_input();
    return parse_mesh(bytes.text(), format_of_bytes(bytes.text()), bytes.name, notes);
  }
  const MeshFormat format = readable_format_of(path);
  return parse_mesh(open_file(path).text(), format, path, notes);
}

}  // namespace deliso
