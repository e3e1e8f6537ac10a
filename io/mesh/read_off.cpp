// SPDX-License-Identifier: MIT
// OFF (Geomview): the keyword, the counts, a line per vertex, a line per facet. '#' opens a
// comment. Numbers after the first three of a vertex (normals, colors) and after a facet's corners
// (colors) are skipped.

#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

// Moves to the next line with a word. Cuts off its comment and appends it to `comments`.
bool next_line_with_words(Lines& lines, std::vector<std::string>* comments = nullptr) {
  while (lines.next()) {
    std::string_view probe = lines.line() = without_comment(lines.line(), comments);
    if (!take_word(probe).empty()) return true;
  }
  return false;
}

std::uint64_t take_count(Lines& lines, const char* what) {
  const std::string_view word = take_word(lines.line());
  const auto count = number_in<std::uint64_t>(word);
  if (!count) lines.fail("the number of ", what, " is ", quote(word));
  return *count;
}

}  // namespace

MeshParts parse_off(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& /*budget*/) {
  Lines lines(bytes, name);
  MeshParts mesh;
  if (!next_line_with_words(lines, &mesh.comments)) lines.fail("the file is empty");
  const std::string_view keyword = take_word(lines.line());
  // Prefixes: ST texture, C color, N normal; 4 and n change the number of coordinates.
  if (!keyword.ends_with("OFF") ||
      keyword.find_first_not_of("STCN") != keyword.size() - std::string_view("OFF").size()) {
    lines.fail("opens with ", quote(keyword), " instead of OFF, COFF, NOFF or STOFF");
  }
  std::string_view behind = lines.line();
  const std::string_view next_word = take_word(behind);
  if (next_word == "BINARY") lines.fail("binary OFF is not supported");
  if (next_word.empty() && !next_line_with_words(lines, &mesh.comments))
    lines.fail("the file ends before the counts");

  const std::uint64_t vertices = take_count(lines, "vertices");
  const std::uint64_t faces = take_count(lines, "facets");
  if (vertices > kMostVertices) lines.fail(vertices, " vertices are too many");
  for (std::uint64_t v = 0; v < vertices; ++v) {
    if (!next_line_with_words(lines)) {
      lines.fail("the file ends after ", v, " of ", vertices, " vertices");
    }
    mesh.points.push_back(take_point(lines.line(), v, lines));
  }

  std::vector<VertexId> corners;
  for (std::uint64_t f = 0; f < faces; ++f) {
    if (!next_line_with_words(lines)) {
      lines.fail("the file ends after ", f, " of ", faces, " facets");
    }
    const std::uint64_t size = take_count(lines, "corners");
    if (size < 3) lines.fail("facet ", f, " has ", size, " corners");
    corners.clear();
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::string_view word = take_word(lines.line());
      const auto corner = number_in<std::uint64_t>(word);
      if (!corner || *corner >= vertices) {
        lines.fail("corner ", i, " of facet ", f, " is ", quote(word), ", not one of ", vertices,
                   " vertices");
      }
      corners.emplace_back(*corner);
    }
    mesh.add_polygon(corners);
  }
  if (next_line_with_words(lines)) lines.fail("something follows the last of ", faces, " facets");
  return mesh;
}

}  // namespace deliso
