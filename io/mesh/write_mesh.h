// SPDX-License-Identifier: MIT
// Writes a triangle mesh as PLY, OFF, OBJ, STL, VTP, glTF, 3MF, or for TetGen.
//
// The same mesh gives the same bytes on every machine. Numbers in text are the shortest that read
// back the same, in any locale. Binary is little endian. Files contain no time or place. They
// appear whole or not at all (io/files/atomic_file.h); `-` is standard output.
//
// A comment is one line at the head of the file: PLY `comment`, an XML comment in VTP and 3MF,
// `extras` of the asset in glTF, else `#`. In STL it follows the title, if the 80 bytes suffice.
// Bytes that one of these formats does not allow are written as `?`: all but printable ASCII, `\`,
// a second `-` in a row.
//
// glTF and 3MF give an object a name, in UTF-8, and hold several objects, as VTP does. There they
// are one set of polygons, with arrays `label` and `color`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

enum class MeshFormat : std::uint8_t {
  ply,       // binary little endian, or ASCII when asked
  off,       // text, Geomview's
  obj,       // text, Wavefront's
  stl,       // binary: single precision triangles with normals, no sharing of vertices
  vtp,       // VTK XML PolyData with raw appended arrays, for ParaView and Slicer
  glb,       // glTF 2.0, binary: single precision, for web pages and modelers
  three_mf,  // 3MF: a zip archive of XML, for printers
  // Written, not read:
  smesh,  // text for TetGen, one line a facet
  poly,   // text for TetGen, two lines a facet
};

constexpr bool is_read(MeshFormat format) {
  return format <= MeshFormat::three_mf;
}
// True if coordinates are float whatever is asked.
constexpr bool is_always_single(MeshFormat format) {
  return format == MeshFormat::stl || format == MeshFormat::glb;
}
constexpr bool holds_objects(MeshFormat format) {
  return format == MeshFormat::vtp || format == MeshFormat::glb || format == MeshFormat::three_mf;
}
constexpr bool holds_attributes(MeshFormat format) {
  return format == MeshFormat::ply || format == MeshFormat::vtp || format == MeshFormat::glb;
}

// Returns the format of the ending of `path`, in upper or lower case. For another ending throws an
// InputError that lists the endings.
MeshFormat mesh_format_of(std::string_view path);
// The same for formats that are read.
MeshFormat readable_format_of(std::string_view path);
// True if the path has the ending of a format that is read.
bool has_mesh_ending(std::string_view path);

// Values of vertices and facets, in the order of the mesh. PLY and VTP hold them as they are. glTF
// has no values of facets: a vertex gets the component of its facets and their largest distance,
// and caps are a primitive of their own.
struct MeshAttributes {
  std::vector<std::array<float, 3>> normals;  // per vertex: unit, in the world
  std::vector<std::uint32_t> component;       // per facet, counted from 0
  std::vector<float> distance;                // per facet
};

// The label that an object is made of, and the color (sRGB) that stands for it.
struct ObjectLabel {
  std::int64_t number = 0;
  std::array<std::uint8_t, 3> color{};
};

struct MeshWriteOptions {
  std::optional<MeshFormat> format{};  // absent: by the path's ending, PLY on standard output
  bool single_precision = false;       // coordinates as float instead of double (STL, glTF: always)
  bool ascii = false;                  // PLY only
  std::string comment{};               // empty: none
  // Facets from this one on are caps. TetGen's formats mark them 2, others 1, if there are no
  // `sides`; PLY, VTP and glTF mark them if there are attributes. Absent: no caps were asked for.
  std::optional<std::size_t> first_cap{};
  std::optional<MeshAttributes> attributes{};  // pre: holds_attributes()
  // Per facet the labels in front of it and behind, or empty. A cap has -1 - face (BoxFace) in
  // front for the face of the box that it is on. PLY and VTP hold them. TetGen's formats have a
  // marker for each pair, and a point in each bounded region with its label
  // (io/mesh/region_points.h). pre: no attributes.
  std::vector<std::array<std::int64_t, 2>> sides{};
  // Runs of such facets, in order, with what glTF calls them: each is a primitive with a material
  // of its own, and all have the same vertices.
  struct Group {
    std::size_t first;
    std::string name;
    std::array<std::uint8_t, 3> color;
  };
  std::vector<Group> groups{};
  std::string name{};  // of the object; empty: the file's without its ending, or "mesh"
  std::optional<ObjectLabel> label{};  // pre: holds_objects()
};

// True if coordinates are rounded to float: with single_precision, in STL and in glTF. pre:
// options.format.
bool writes_single_precision(const MeshWriteOptions& options);
// Returns the point of the world that coordinates are relative to: in glTF the mesh's middle. pre:
// options.format.
Vec3 written_origin(const TriMesh& mesh, const MeshWriteOptions& options);
// Returns the points as the file will have them: in the world, relative to written_origin(),
// rounded if it rounds. pre: options.format.
std::vector<Vec3> written_points(const TriMesh& mesh, const MeshWriteOptions& options);

// A mesh as its file has it; the facets are not linked.
struct WrittenMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};
WrittenMesh written_mesh(const TriMesh& mesh, const MeshWriteOptions& options);

// Writes the mesh in world coordinates. A known space is written as SPACE=RAS or LPS in a
// comment, in VTP as field data for 3D Slicer. Throws InputError on an unknown ending and on every
// fault of the file system.
void write_mesh(const TriMesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

// An object of a file of several. All have attributes, or none; likewise labels, caps, and
// precision.
struct MeshObject {
  TriMesh mesh;
  MeshWriteOptions options;  // comment and space of the first object are the file's
};
// The same for all objects. pre: there is one; the format, by options or path, holds_objects().
void write_objects(std::span<const MeshObject> objects, const std::string& path);

}  // namespace deliso
