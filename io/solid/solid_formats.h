// SPDX-License-Identifier: MIT
// The writers and parsers of solids, one per format, and their common functions.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"
#include "io/files/put_numbers.h"
#include "io/solid/read_solid.h"
#include "io/solid/write_solid.h"

namespace deliso {

// What walls with one marker have in common.
struct WallKind {
  std::uint32_t kind;
  RegionId front, behind;
  // NOLINTNEXTLINE(modernize-use-nullptr): the comparison has no pointer.
  friend auto operator<=>(const WallKind&, const WallKind&) = default;
};

// A solid as files have it, in the world.
struct MarkedSolid {
  Solid solid;
  RegionId regions = 0;               // the last one
  std::vector<std::int64_t> labels;   // of region r: labels[r - 1]
  std::vector<std::int32_t> numbers;  // the same in 32 bits and positive
  std::vector<std::string> names;     // empty: none
  std::vector<WallKind> kinds;        // of marker m: kinds[m - 1]
  std::vector<std::int32_t> markers;  // of each wall
  std::vector<std::string> head;      // comments that every format allows
  std::string_view space;             // RAS, LPS or empty
};

// Writes each comment between these.
void put_head(AtomicFile& out, const MarkedSolid& marked, std::string_view before,
              std::string_view after);
// Appends the coordinates of a point as text.
void put_point(AtomicFile& out, const Vec3& p, char after);

// `path`: of TetGen's files, any of three.
void write_medit(const MarkedSolid& marked, const std::string& path);
void write_vtu(const MarkedSolid& marked, const std::string& path);
void write_gmsh(const MarkedSolid& marked, const std::string& path);
void write_tetgen_solid(const MarkedSolid& marked, const std::string& path);

// A solid as its file has it: its regions are not yet set.
struct ParsedSolid {
  Solid solid;
  std::vector<std::int64_t> labels;  // of each cell
};
ParsedSolid parse_medit(const Bytes& bytes);
ParsedSolid parse_vtu(const Bytes& bytes);

inline constexpr std::uint64_t kMostPoints = kNoId - 1, kMostCells = kNoId / 4;

}  // namespace deliso
