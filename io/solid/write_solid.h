// SPDX-License-Identifier: MIT
// Writes a solid of tetrahedra for Medit, Gmsh, VTK, or in TetGen's formats.
//
// The same solid gives the same bytes on every machine. Coordinates are doubles; in text, the
// shortest that read back the same. Files contain no time or place. They appear whole or not at all
// (io/files/atomic_file.h); `-` is standard output, but not for TetGen's three files.
//
//   W1  Points, cells and walls are in the order of the solid.
//   W2  Cells are positively oriented: det[b - a, c - a, d - a] > 0, in all four formats.
//   W3  A wall is counter-clockwise seen from its front, where the region of the smaller number is:
//       outside, or the first of the two.
//   W4  A region has the number of its label; if these are not all from 1 to 2^31 - 1, in VTK's
//       format still, in others its own. Walls have a marker for each triple of kind, region in
//       front and region behind, counted from 1 in that order. A table in the comments explains
//       all.
//   W5  Only Gmsh's format has names: the label's for a volume, "behind|front" for a surface.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame.h"
#include "more/solids/solid.h"

namespace deliso {

enum class SolidFormat : std::uint8_t {
  medit,   // .mesh: text, Medit's, with triangles and tetrahedra
  vtu,     // VTK XML UnstructuredGrid with raw appended arrays: tetrahedra alone
  gmsh,    // .msh: text of Gmsh 4.1, a volume for each region and a surface for each marker
  tetgen,  // .node, .ele and .face: three files of one name
};

// Formats that read_solid reads.
constexpr bool is_read(SolidFormat format) {
  return format <= SolidFormat::vtu;
}

// Returns the format of the ending of `path`, in upper or lower case: of TetGen's, any of three.
// For another ending throws an InputError that lists the endings.
SolidFormat solid_format_of(std::string_view path);
bool has_solid_ending(std::string_view path);

// Returns the paths of the files that write_solid writes: three in TetGen's format, named by
// `path` without its ending. An empty path is none. `format`: as SolidWriteOptions has it.
std::vector<std::string> solid_files(const std::string& path, std::optional<SolidFormat> format);

// What a region is made of.
struct RegionLabel {
  std::int64_t number = 0;
  std::string name{};  // UTF-8; empty: none
};

struct SolidWriteOptions {
  std::optional<SolidFormat> format{};  // absent: by the path's ending, Medit on standard output
  std::string comment{};                // empty: none
  // Of region r, labels[r - 1]. Empty: a region's number is its label.
  std::vector<RegionLabel> labels{};
};

// Writes the solid in world coordinates, as the frame says. A mirroring frame turns cells and
// walls, so that W2 and W3 hold in the world. A known space is written as SPACE=RAS or LPS in a
// comment. Throws InputError on an unknown ending and on every fault of the file system.
// pre: labels are empty or for all regions.
void write_solid(const Solid& solid, const Frame& frame, const std::string& path,
                 const SolidWriteOptions& options = {});

// Returns the solid as its file will have it: points in the world, cells and walls turned as W2 and
// W3 ask. Rounding may turn the flattest cells inside out, which check_solid reports.
Solid written_solid(const Solid& solid, const Frame& frame);

}  // namespace deliso
