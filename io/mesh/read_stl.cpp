// SPDX-License-Identifier: MIT
// STL (3D Systems 1989): triangles by the positions of their corners, in single precision. Binary
// (write_stl.cpp has the layout), or text: "solid name", for each triangle "facet normal" and three
// numbers, "outer loop", three times "vertex" and three numbers, "endloop", "endfacet"; "endsolid".
// A file may have several solids. Binary files can begin with "solid" too; their size decides.
#include <cstdint>
#include <utility>

#include "io/mesh/mesh_formats.h"
#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

constexpr std::size_t kFacet = 50;  // bytes

std::uint32_t count_in(std::string_view bytes) {
  return FieldReader(bytes, std::endian::little).get<std::uint32_t>(kStlHeader);
}

// Merges corners by rule R6. `corners`: three per triangle.
void merge_corners(std::vector<Vec3> corners, MeshParts& mesh) {
  const std::vector<VertexId> vertex = merge_points(corners);
  mesh.points = std::move(corners);
  mesh.triangles.reserve(vertex.size() / 3);
  for (std::size_t c = 0; c + 2 < vertex.size(); c += 3) {
    mesh.triangles.push_back({vertex[c], vertex[c + 1], vertex[c + 2]});
  }
}

// Rule R5: the text after the writer's own title is a comment by itself.
void keep_header(std::string_view header, std::vector<std::string>& comments) {
  header = header.substr(0, header.find('\0'));
  if (!header.starts_with(kStlTitle)) return keep_comment(header, comments);
  std::string_view rest = header.substr(kStlTitle.size());
  std::string_view probe = rest;
  if (take_word(probe).starts_with("SPACE=")) rest = probe;
  keep_comment(header.substr(0, header.size() - rest.size()), comments);
  keep_comment(rest, comments);
}

MeshParts parse_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kStlHeader + 4) fail(name, "is no STL file: it ends within the header");
  const std::uint64_t count = count_in(bytes);
  const std::string_view facets = bytes.substr(kStlHeader + 4);
  if (count > kMostFaces) fail(name, count, " facets are too many");
  if (facets.size() != count * kFacet) {
    fail(name, "binary STL of ", count, " facets needs ", count * kFacet,
         " bytes behind its header, found ", facets.size());
  }
  MeshParts mesh;
  keep_header(bytes.substr(0, kStlHeader), mesh.comments);
  const FieldReader fields(facets, std::endian::little);
  // -0 and 0 are one position.
  const auto coordinate = [&](std::size_t at) {
    return static_cast<double>(fields.get<float>(at)) + 0.0;
  };
  std::vector<Vec3> corners;
  corners.reserve(3 * count);
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {  // the first vector is the normal
      const std::size_t at = f * kFacet + 12 * corner;
      corners.push_back({coordinate(at), coordinate(at + 4), coordinate(at + 8)});
    }
  }
  merge_corners(std::move(corners), mesh);
  return mesh;
}

// The words of the text kind; line ends do not matter.
class WordReader {
 public:
  explicit WordReader(Lines& lines) : lines_(lines) {}

  // In lower case; empty at the end of the file.
  std::string next() { return lower(raw()); }
  void expect(std::string_view wanted) {
    const std::string word = next();
    if (word != wanted) lines_.fail("there is ", quote(word), " in place of ", quote(wanted));
  }
  // Returns a float, as in the binary kind.
  double number() {
    const std::string_view word = raw();
    const auto value = number_in<double>(word);
    if (!value) lines_.fail("there is ", quote(word), " in place of a number");
    return static_cast<double>(static_cast<float>(*value)) + 0.0;
  }
  void skip_line() { lines_.line() = {}; }

 private:
  std::string_view raw() {
    std::string_view word = take_word(lines_.line());
    while (word.empty() && lines_.next()) word = take_word(lines_.line());
    return word;
  }

  Lines& lines_;
};

MeshParts parse_ascii(std::string_view bytes, const std::string& name) {
  Lines lines(bytes, name);
  WordReader words(lines);
  MeshParts mesh;
  std::vector<Vec3> corners;
  words.expect("solid");
  keep_comment(lines.line(), mesh.comments);
  words.skip_line();
  for (bool inside = true;;) {
    const std::string word = words.next();
    if (!inside) {
      if (word.empty()) break;
      if (word != "solid") lines.fail("there is ", quote(word), " behind 'endsolid'");
      words.skip_line();
      inside = true;
    } else if (word == "endsolid") {
      words.skip_line();  // the name again
      inside = false;
    } else {
      if (word.empty()) lines.fail("the file ends before 'endsolid'");
      if (word != "facet") lines.fail("there is ", quote(word), " in place of 'facet'");
      words.expect("normal");
      for (int axis = 0; axis < 3; ++axis) words.next();  // may be nan
      words.expect("outer");
      words.expect("loop");
      for (int corner = 0; corner < 3; ++corner) {
        words.expect("vertex");
        const double x = words.number(), y = words.number();
        corners.push_back({x, y, words.number()});
      }
      words.expect("endloop");
      words.expect("endfacet");
      if (corners.size() / 3 > kMostFaces) lines.fail("too many facets");
    }
  }
  merge_corners(std::move(corners), mesh);
  return mesh;
}

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= kStlHeader + 4 &&
         bytes.size() - kStlHeader - 4 == kFacet * std::uint64_t{count_in(bytes)};
}

}  // namespace

bool looks_like_binary_stl(std::string_view bytes) {
  // No text holds a zero byte.
  return has_binary_size(bytes) ||
         bytes.substr(0, kStlHeader + 4).find('\0') != std::string_view::npos;
}

MeshParts parse_stl(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& /*budget*/) {
  std::string_view probe = bytes.substr(0, kStlHeader);
  const bool text_kind = lower(take_word(probe)) == "solid" && !has_binary_size(bytes);
  return text_kind ? parse_ascii(bytes, name) : parse_binary(bytes, name);
}

}  // namespace deliso
