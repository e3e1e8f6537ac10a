// SPDX-License-Identifier: MIT
// Medit's .mesh as text (write_medit.cpp). Words may be divided among lines at will.
#include <algorithm>
#include <limits>

#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/solid/solid_formats.h"

namespace deliso {
namespace {

// Sections that are skipped, with the numbers that an entry has.
struct SkippedRow {
  std::string_view keyword;
  int numbers;
};
constexpr SkippedRow kSkipped[] = {{"Edges", 3},
                                   {"Corners", 1},
                                   {"Ridges", 1},
                                   {"RequiredVertices", 1},
                                   {"RequiredEdges", 1},
                                   {"RequiredTriangles", 1},
                                   {"Normals", 3},
                                   {"Tangents", 3},
                                   {"NormalAtVertices", 2},
                                   {"TangentAtVertices", 2}};

class MeditParser {
 public:
  explicit MeditParser(const Bytes& bytes) : name_(bytes.name), words_(bytes.text()) {}

  ParsedSolid run() {
    if (word() != "MeshVersionFormatted") fail(name_, "does not begin with MeshVersionFormatted");
    number<std::int64_t>("the version");
    for (std::string_view keyword = word(); keyword != "End"; keyword = word()) {
      if (keyword.empty()) fail(name_, "ends before End");
      read_section(keyword);
    }
    const std::size_t points = parts_.solid.points.size();
    if (largest_ > points) {
      fail(name_, "a corner is point ", largest_, ", and there are ", points);
    }
    return std::move(parts_);
  }

 private:
  std::string_view word() {
    std::string_view next = words_.word();
    while (next.starts_with('#')) {
      // The rest of the line is a comment; the word itself may be followed by its end.
      if (!words_.at_end() && words_.rest().front() != '\n') words_.line();
      next = words_.word();
    }
    return next;
  }

  template <class T>
  T number(const char* what) {
    const std::string_view next = word();
    const auto value = number_in<T>(next);
    if (!value) fail(name_, what, " is ", quote(next), " at byte ", words_.position());
    return *value;
  }

  VertexId corner() {
    const auto v = number<std::int64_t>("a corner");
    if (v < 1 || v > std::int64_t{kMostPoints}) fail(name_, "a corner is point ", v);
    largest_ = std::max(largest_, static_cast<std::size_t>(v));
    return VertexId(v - 1);
  }

  void read_section(std::string_view keyword) {
    if (keyword == "Dimension") {
      const auto dimension = number<std::int64_t>("the dimension");
      if (dimension != 3) fail(name_, "has ", dimension, " dimensions, not 3");
      return;
    }
    const auto count = number<std::uint64_t>("the count of a section");
    Solid& solid = parts_.solid;
    if (keyword == "Vertices") {
      for (std::uint64_t n = 0; n < count; ++n) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = number<double>("a coordinate");
        number<std::int64_t>("the reference of a vertex");
        if (solid.points.size() == kMostPoints) fail(name_, "has too many vertices");
        solid.points.push_back(p);
      }
    } else if (keyword == "Triangles") {
      for (std::uint64_t n = 0; n < count; ++n) {
        Wall wall;
        for (VertexId& v : wall.v) v = corner();
        wall.kind = static_cast<std::uint32_t>(number<std::int64_t>("the reference of a triangle"));
        solid.walls.push_back(wall);
      }
    } else if (keyword == "Tetrahedra") {
      for (std::uint64_t n = 0; n < count; ++n) {
        Tetrahedron cell;
        for (VertexId& v : cell) v = corner();
        parts_.labels.push_back(number<std::int64_t>("the reference of a tetrahedron"));
        if (solid.cells.size() == kMostCells) fail(name_, "has too many tetrahedra");
        solid.cells.push_back(cell);
      }
    } else {
      skip_section(keyword, count);
    }
  }

  void skip_section(std::string_view keyword, std::uint64_t count) {
    const auto* row = std::ranges::find(kSkipped, keyword, &SkippedRow::keyword);
    if (row == std::end(kSkipped)) fail(name_, quote(keyword), " is not supported");
    for (std::uint64_t n = 0; n < count; ++n) {
      for (int k = 0; k < row->numbers; ++k) number<double>("a number that is skipped");
    }
  }

  const std::string& name_;
  TextCursor words_;
  ParsedSolid parts_;
  std::size_t largest_ = 0;  // corner, counted from 1
};

}  // namespace

ParsedSolid parse_medit(const Bytes& bytes) {
  return MeditParser(bytes).run();
}

}  // namespace deliso
