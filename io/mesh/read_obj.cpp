// SPDX-License-Identifier: MIT
// OBJ (Wavefront): a statement a line, '#' opens a comment, '\' at the end continues the line.
// Corners are v, v/vt, v//vn or v/vt/vn, counted from 1, or from the last one backwards when
// negative. A facet may name vertices that come later.
#include <algorithm>
#include <array>

#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

// Statements without vertices or facets. Any other word is a fault: otherwise free-form surfaces
// would be lost without notice, and a file of another format would be an empty mesh.
constexpr std::array<std::string_view, 12> kSkipped{"vt", "vn",     "vp",     "g", "o", "s",
                                                    "mg", "mtllib", "usemtl", "l", "p", "lod"};

// Returns the next statement, with continued lines joined in `joined`. `comments`, if given,
// receives the skipped comments.
bool next_statement(Lines& lines, std::string& joined, std::string_view& statement,
                    std::vector<std::string>* comments) {
  while (lines.next()) {
    statement = lines.line();
    if (statement.ends_with('\\')) {
      joined.clear();
      for (bool more = true; more;) {
        const std::string_view line = lines.line();
        more = line.ends_with('\\');
        joined.append(line.substr(0, line.size() - (more ? 1 : 0))) += ' ';
        more = more && lines.next();
      }
      statement = joined;
    }
    std::string_view probe = statement = without_comment(statement, comments);
    if (!take_word(probe).empty()) return true;
  }
  return false;
}

// The largest vertex named before it was defined, and where.
struct Forward {
  std::uint64_t index = 0;
  std::size_t line = 0;
};

VertexId corner_in(std::string_view word, std::uint64_t vertices, const Lines& lines,
                   Forward& forward) {
  const auto index = number_in<std::int64_t>(word.substr(0, word.find('/')));
  if (!index || *index == 0) lines.fail("a facet's corner is ", quote(word));
  if (*index < 0) {
    const std::uint64_t back = std::uint64_t{0} - static_cast<std::uint64_t>(*index);
    if (back > vertices) {
      lines.fail("corner ", quote(word), " lies before the first of ", vertices, " vertices");
    }
    return VertexId(vertices - back);
  }
  const auto v = static_cast<std::uint64_t>(*index) - 1;
  if (v > kMostVertices) lines.fail("a facet's corner is ", quote(word));
  if (v >= vertices && v >= forward.index) forward = {v, lines.number()};
  return VertexId(v);
}

}  // namespace

MeshParts parse_obj(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& /*budget*/) {
  Lines lines(bytes, name);
  MeshParts mesh;
  Forward forward;
  std::vector<VertexId> corners;
  std::string joined;
  std::string_view statement;
  std::vector<std::string>* head = &mesh.comments;
  for (; next_statement(lines, joined, statement, head); head = nullptr) {
    const std::string_view keyword = take_word(statement);
    if (keyword == "v") {
      mesh.points.push_back(take_point(statement, mesh.points.size() + 1, lines));
      if (mesh.points.size() > kMostVertices) lines.fail("too many vertices");
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view word = take_word(statement); !word.empty();
           word = take_word(statement)) {
        corners.push_back(corner_in(word, mesh.points.size(), lines, forward));
      }
      if (corners.size() < 3) lines.fail("a facet of ", corners.size(), " corners");
      mesh.add_polygon(corners);
    } else if (std::find(kSkipped.begin(), kSkipped.end(), keyword) == kSkipped.end()) {
      lines.fail("unknown statement ", quote(keyword));
    }
  }
  if (take_word(bytes).empty()) lines.fail("the file is empty");
  if (forward.line != 0 && forward.index >= mesh.points.size()) {
    lines.fail_at(forward.line, "a facet names vertex ", forward.index + 1, " of ",
                  mesh.points.size());
  }
  return mesh;
}

}  // namespace deliso
