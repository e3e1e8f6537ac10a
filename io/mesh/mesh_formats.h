// SPDX-License-Identifier: MIT
// The writers of write_mesh, one per format, and their common functions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/put_numbers.h"
#include "io/mesh/write_mesh.h"

namespace deliso {

// A mesh as files have it: in the world, with reversed facets if the frame mirrors; its name and
// comment. Keeps references to the mesh and the options.
class WorldMesh {
 public:
  WorldMesh(const TriMesh& mesh, const MeshWriteOptions& options, std::string_view path = {});

  const MeshWriteOptions& options() const { return options_; }
  // Returns the object's name in UTF-8, without control characters.
  const std::string& name() const { return name_; }

  std::size_t vertex_count() const { return mesh_.points.size(); }
  std::size_t face_count() const { return mesh_.faces.size(); }
  Vec3 point(std::size_t v) const { return mesh_.frame.to_world(mesh_.points[VertexId(v)]); }
  std::string_view space() const { return short_name_of(mesh_.frame.space); }
  // Returns the comment between these strings; empty if there is none.
  std::string comment_line(std::string_view before, std::string_view after) const {
    return comment_.empty() ? "" : std::string(before) + comment_ + std::string(after);
  }
  // Returns the text after the program's name; empty if the space is unknown.
  std::string space_note() const { return space().empty() ? "" : " SPACE=" + std::string(space()); }
  // Returns the two as a comment between these strings, for formats that open otherwise.
  std::string space_line(std::string_view before, std::string_view after) const {
    return space().empty() ? "" : text(before, "DelIso", space_note(), after);
  }
  // True if no facet has an edge on a boundary.
  bool is_closed() const;
  Triangle triangle(std::size_t f) const {
    const Triangle& v = mesh_.faces[FaceId(f)].v;
    return mirrored_ ? Triangle{v[0], v[2], v[1]} : v;
  }

 private:
  const TriMesh& mesh_;
  const MeshWriteOptions& options_;
  bool mirrored_;
  std::string name_;
  std::string comment_;  // printable ASCII, without "\" and "--"
};

// Free bytes at the beginning of binary STL, and the title with which the writer begins them.
inline constexpr std::size_t kStlHeader = 80;
inline constexpr std::string_view kStlTitle = "binary STL by DelIso";

// Calls put(coordinate, axis) for x, y, z of every vertex, as float or double.
template <class Put>
void for_each_coordinate(const WorldMesh& mesh, Put put) {
  const bool single_precision = mesh.options().single_precision;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.point(v);
    for (int axis = 0; axis < 3; ++axis) {
      if (single_precision) {
        put(static_cast<float>(p[axis]), axis);
      } else {
        put(p[axis], axis);
      }
    }
  }
}

// The magic number of binary glTF, and the types of its chunks.
inline constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbJson = 0x4e4f534a,
                               kGlbBinary = 0x004e4942;

inline constexpr double kMeters = 0.001;  // of a millimeter

// Returns a share of a color of glTF, which is linear, from one of sRGB. The polynomial is within
// 0.002 of sRGB's curve, and the same on every machine.
inline float linear_of(std::uint8_t srgb) {
  const double x = srgb / 255.0;
  return static_cast<float>(x * (x * (x * 0.305306011 + 0.682171111) + 0.012522878));
}

// Returns the point that coordinates in glTF are relative to: the middle of the mesh, as floats.
Vec3 glb_origin(const WorldMesh& mesh);

// pre: one object, unless the format holds_objects().
using MeshWriter = void(AtomicFile& out, std::span<const WorldMesh> objects);
MeshWriter write_ply, write_off, write_obj, write_stl, write_vtp, write_glb, write_3mf, write_smesh,
    write_poly;

}  // namespace deliso
