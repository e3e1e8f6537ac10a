// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names elements and their properties, then the elements' data,
// as words or as binary of either byte order. Reads x, y, z of `vertex`, the list vertex_indices
// (or vertex_index) of `face`. Other properties are skipped by their declared type.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/sample_type.h"
#include "io/files/field_reader.h"
#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

struct Property {
  std::string name;
  SampleType type = SampleType::f32;
  bool is_list = false;
  SampleType count_type = SampleType::u8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  // kNoId if there is none.
  std::size_t index_of(std::string_view wanted) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == wanted) return i;
    }
    return kNoId;
  }
};

struct Header {
  std::optional<std::endian> byte_order;  // of binary data
  std::vector<Element> elements;
  std::vector<std::string> comments;
};

SampleType type_in(std::string_view word, const Lines& lines) {
  // Each has a second name, that of SampleType.
  constexpr std::array<std::string_view, 8> kNames = {"uchar", "char", "ushort", "short",
                                                      "uint",  "int",  "float",  "double"};
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    const auto type = static_cast<SampleType>(n);
    if (word == kNames[n] || word == name_of(type)) return type;
  }
  lines.fail("unknown type ", quote(word));
}

std::optional<std::endian> byte_order_in(std::string_view word, const Lines& lines) {
  if (word == "ascii") return std::nullopt;
  if (word == "binary_little_endian") return std::endian::little;
  if (word == "binary_big_endian") return std::endian::big;
  lines.fail("unknown format ", quote(word));
}

Property property_in(std::string_view line, const Lines& lines) {
  Property property;
  std::string_view word = take_word(line);
  if (word == "list") {
    property.is_list = true;
    property.count_type = type_in(take_word(line), lines);
    if (!is_integer(property.count_type)) lines.fail("a list's length is no integer type");
    word = take_word(line);
  }
  property.type = type_in(word, lines);
  property.name = take_word(line);
  if (property.name.empty()) lines.fail("a property without a name");
  return property;
}

// Leaves `lines` at end_header.
Header parse_header(Lines& lines) {
  if (!lines.next() || take_word(lines.line()) != "ply") lines.fail("does not open with 'ply'");
  Header header;
  bool has_format = false;
  while (lines.next()) {
    std::string_view line = lines.line();
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") {
      if (!has_format) lines.fail("the header names no format");
      return header;
    }
    if (keyword == "comment") keep_comment(line, header.comments);
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      header.byte_order = byte_order_in(take_word(line), lines);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = take_word(line);
      const std::string_view word = take_word(line);
      const auto count = number_in<std::uint64_t>(word);
      if (!count) lines.fail("the number of ", quote(element.name), " is ", quote(word));
      element.count = *count;
      header.elements.push_back(element);
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.fail("a property before the first element");
      header.elements.back().properties.push_back(property_in(line, lines));
    } else {
      lines.fail("unknown header line ", quote(keyword));
    }
  }
  lines.fail("the header has no end");
}

// The data as words.
class WordSource {
 public:
  // `lines` stands on end_header.
  explicit WordSource(Lines lines) : lines_(std::move(lines)) { lines_.line() = {}; }

  double next(SampleType type) {
    std::string_view word = take_word(lines_.line());
    while (word.empty()) {
      if (!lines_.next()) fail("the file ends too early");
      word = take_word(lines_.line());
    }
    // The digits of a float are read as a float, so that text and binary agree.
    const std::optional<double> value = type == SampleType::f32
                                            ? std::optional<double>(number_in<float>(word))
                                            : number_in<double>(word);
    if (!value || (is_integer(type) && *value != std::trunc(*value))) {
      fail("there is ", quote(word), " in place of a number");
    }
    return *value;
  }
  void expect_end() {
    do {
      if (!take_word(lines_.line()).empty()) fail("something follows the last element");
    } while (lines_.next());
  }
  [[noreturn]] void fail(const auto&... fault) const { lines_.fail(fault...); }

 private:
  Lines lines_;
};

// The data as binary.
class BinarySource {
 public:
  BinarySource(const Lines& lines, std::string_view bytes, std::endian order, std::string name)
      : bytes_(bytes),
        fields_(bytes, order),
        at_(bytes.size() - lines.rest().size()),
        name_(std::move(name)) {}

  double next(SampleType type) {
    return with_type(type, [&]<class T>(T) {
      if (bytes_.size() - at_ < sizeof(T)) fail("the file ends too early");
      at_ += sizeof(T);
      return static_cast<double>(fields_.get<T>(at_ - sizeof(T)));
    });
  }
  void expect_end() const {
    for (std::size_t i = at_; i < bytes_.size(); ++i) {
      if (!is_space(bytes_[i])) fail(bytes_.size() - at_, " bytes follow the last element");
    }
  }
  [[noreturn]] void fail(const auto&... fault) const {
    throw InputError(name_, " byte ", at_, ": ", fault...);
  }

 private:
  std::string_view bytes_;
  FieldReader fields_;
  std::size_t at_;
  std::string name_;
};

template <class Source>
std::uint64_t list_length(Source& source, const Property& property) {
  const double length = source.next(property.count_type);
  if (length < 0 || length > std::numeric_limits<std::uint32_t>::max()) {
    source.fail("a list of length ", length);
  }
  return static_cast<std::uint64_t>(length);
}

template <class Source>
void skip_property(Source& source, const Property& property) {
  const std::uint64_t count = property.is_list ? list_length(source, property) : 1;
  for (std::uint64_t i = 0; i < count; ++i) source.next(property.type);
}

template <class Source>
void read_vertices(Source& source, const Element& element, MeshParts& mesh) {
  // Per property: its axis, or 3.
  std::vector<int> axis_of(element.properties.size(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, static_cast<char>('x' + axis));
    const std::size_t i = element.index_of(name);
    if (i == kNoId || element.properties[i].is_list) {
      source.fail("vertices have no coordinate ", name);
    }
    axis_of[i] = axis;
  }
  for (std::uint64_t v = 0; v < element.count; ++v) {
    Vec3 p;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (axis_of[i] == 3) {
        skip_property(source, property);
        continue;
      }
      p[axis_of[i]] = source.next(property.type);
    }
    mesh.points.push_back(p);
  }
}

template <class Source>
void read_faces(Source& source, const Element& element, std::uint64_t vertices, MeshParts& mesh) {
  if (element.count == 0) return;
  std::size_t indices = element.index_of("vertex_indices");
  if (indices == kNoId) indices = element.index_of("vertex_index");
  if (indices == kNoId || !element.properties[indices].is_list ||
      !is_integer(element.properties[indices].type)) {
    source.fail("facets have no integer list vertex_indices");
  }
  const std::array labels{element.index_of("label_front"), element.index_of("label_behind")};
  const bool has_labels = std::ranges::all_of(labels, [&](std::size_t i) {
    return i != kNoId && !element.properties[i].is_list &&
           element.properties[i].type == SampleType::i32;
  });
  std::array<std::int64_t, 2> sides{};
  std::vector<VertexId> corners;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (has_labels && (i == labels[0] || i == labels[1])) {
        sides[i == labels[1]] = static_cast<std::int64_t>(source.next(property.type));
        continue;
      }
      if (i != indices) {
        skip_property(source, property);
        continue;
      }
      const std::uint64_t size = list_length(source, property);
      if (size < 3) source.fail("facet ", f, " has ", size, " corners");
      corners.clear();
      for (std::uint64_t c = 0; c < size; ++c) {
        const double corner = source.next(property.type);
        if (!(corner >= 0 && corner < static_cast<double>(vertices))) {
          source.fail("corner ", c, " of facet ", f, " is ", corner, ", not one of ", vertices,
                      " vertices");
        }
        corners.emplace_back(static_cast<std::uint32_t>(corner));
      }
      mesh.add_polygon(corners);
    }
    if (has_labels) mesh.sides.resize(mesh.triangles.size(), sides);
  }
}

template <class Source>
MeshParts read_elements(Source source, const Header& header) {
  MeshParts mesh;
  mesh.comments = header.comments;
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const Element& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) source.fail("there is no element 'vertex'");
  if (vertex->count > kMostVertices) source.fail(vertex->count, " vertices are too many");
  for (const Element& element : header.elements) {
    if (element.name == "tristrips") source.fail("triangle strips are not supported");
    if (&element == &*vertex) {
      read_vertices(source, element, mesh);
    } else if (element.name == "face") {
      read_faces(source, element, vertex->count, mesh);
    } else if (!element.properties.empty()) {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip_property(source, property);
      }
    }
  }
  source.expect_end();
  return mesh;
}

}  // namespace

MeshParts parse_ply(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& /*budget*/) {
  Lines lines(bytes, name);
  const Header header = parse_header(lines);
  return header.byte_order
             ? read_elements(BinarySource(lines, bytes, *header.byte_order, name), header)
             : read_elements(WordSource(lines), header);
}

}  // namespace deliso
