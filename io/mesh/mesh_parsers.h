// SPDX-License-Identifier: MIT
// The parsers of read_mesh, one per format, and their common functions.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/expansion_budget.h"
#include "io/files/input_file.h"
#include "io/files/text_scan.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Removes the first word of `text` and returns it; empty if only blanks are left.
inline std::string_view take_word(std::string_view& text) {
  TextCursor cursor(text);
  const std::string_view word = cursor.word();
  text = cursor.rest();
  return word;
}

// The lines of a text file, counted from 1.
class Lines {
 public:
  Lines(std::string_view bytes, const std::string& name) : text_(bytes), name_(name) {}

  // Moves to the next line. Returns false at the end of the file.
  bool next() {
    if (text_.at_end()) return false;
    line_ = text_.line();
    ++number_;
    return true;
  }
  // Returns the rest of the line, without the words that were removed.
  std::string_view& line() { return line_; }
  std::string_view rest() const { return text_.rest(); }
  std::size_t number() const { return number_; }
  [[noreturn]] void fail(const auto&... fault) const { fail_at(number_, fault...); }
  [[noreturn]] void fail_at(std::size_t line, const auto&... fault) const {
    throw InputError(name_, " line ", line, ": ", fault...);
  }

 private:
  TextCursor text_;
  std::string_view line_;
  std::string name_;
  std::size_t number_ = 0;
};

// Removes the coordinates of a vertex from the rest of the line, and returns them. `number`: the
// vertex's, for a message.
inline Vec3 take_point(std::string_view& rest, std::size_t number, const Lines& lines) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = take_word(rest);
    const auto value = number_in<double>(word);
    if (!value) lines.fail("coordinate ", axis, " of vertex ", number, " is ", quote(word));
    p[axis] = *value;
  }
  return p;
}

// Most comments that are kept of a file.
inline constexpr std::size_t kMostComments = 100;

// Appends a comment by rule R5. `line`: without the mark of a comment.
inline void keep_comment(std::string_view line, std::vector<std::string>& comments) {
  line = trimmed(line);
  if (!line.empty() && comments.size() < kMostComments) comments.emplace_back(line);
}

// Returns the line without its comment from # on, which is kept if `comments` is given.
inline std::string_view without_comment(std::string_view line, std::vector<std::string>* comments) {
  const std::size_t mark = line.find('#');
  if (comments && mark != std::string_view::npos) keep_comment(line.substr(mark + 1), *comments);
  return line.substr(0, mark);
}

// The result of a parser. The parser checks corners, since it knows the line; parse_mesh checks
// that points are finite.
struct MeshParts {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::string> comments;
  double rounding = 0;                               // as of MeshNotes
  AnatomicalSpace space = AnatomicalSpace::unknown;  // if it is not in a comment

  std::vector<std::array<std::uint8_t, 3>> colors{};  // as of MeshNotes
  std::vector<std::array<std::int64_t, 2>> sides{};

  // Adds the triangles of a polygon by rule R1. pre: three corners or more.
  void add_polygon(const std::vector<VertexId>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
};

// The color of what has none in a file with colors.
inline constexpr std::array<std::uint8_t, 3> kNoColor{204, 204, 204};

// Limits: vertices that have ids, and facets for link_faces.
inline constexpr std::uint64_t kMostVertices = kNoId - 1;
inline constexpr std::uint64_t kMostFaces = kNoId / 3;

// Merges points at one position, by rule R6. Returns the new number of each.
std::vector<VertexId> merge_points(std::vector<Vec3>& points);

// `name`: in quotes, for messages. `budget`: of formats that use what they hold more than once.
using MeshParser = MeshParts(std::string_view bytes, const std::string& name,
                             const ExpansionBudget& budget);
MeshParser parse_ply, parse_off, parse_obj, parse_stl, parse_vtp, parse_glb, parse_3mf;

// True if the bytes can be binary STL and are no text.
bool looks_like_binary_stl(std::string_view bytes);

}  // namespace deliso
