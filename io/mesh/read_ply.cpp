// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a text header that names elements and their properties, then the elements' data,
// as words or as binary of either byte order. Reads x, y, z of `vertex`, the list vertex_indices
// (or vertex_index) of `face`. Other properties are skipped by their declared type.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

enum class Type : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

constexpr bool is_integer(Type type) {
  return type != Type::f32 && type != Type::f64;
}

struct Property {
  std::string name;
  Type type = Type::f32;
  bool is_list = false;
  Type count_type = Type::u8;
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

enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::vector<std::string> comments;
};

Type type_in(std::string_view word, const Lines& lines) {
  struct Name {
    std::string_view text;
    Type type;
  };
  constexpr Name names[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const Name& name : names) {
    if (name.text == word) return name.type;
  }
  lines.fail(text("unknown type ", quote(word)));
}

Encoding encoding_in(std::string_view word, const Lines& lines) {
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  lines.fail(text("unknown format ", quote(word)));
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
      header.encoding = encoding_in(take_word(line), lines);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = take_word(line);
      const std::string_view word = take_word(line);
      const auto count = number_in<std::uint64_t>(word);
      if (!count) lines.fail(text("the number of ", quote(element.name), " is ", quote(word)));
      element.count = *count;
      header.elements.push_back(element);
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.fail("a property before the first element");
      header.elements.back().properties.push_back(property_in(line, lines));
    } else {
      lines.fail(text("unknown header line ", quote(keyword)));
    }
  }
  lines.fail("the header has no end");
}

// The data as words.
class WordSource {
 public:
  // `lines` stands on end_header.
  explicit WordSource(Lines lines) : lines_(std::move(lines)) { lines_.line() = {}; }

  double next(Type type) {
    std::string_view word = take_word(lines_.line());
    while (word.empty()) {
      if (!lines_.next()) fail("the file ends too early");
      word = take_word(lines_.line());
    }
    // The digits of a float are read as a float, so that text and binary agree.
    const std::optional<double> value =
        type == Type::f32 ? std::optional<double>(number_in<float>(word)) : number_in<double>(word);
    if (!value || (is_integer(type) && *value != std::trunc(*value))) {
      fail(text("there is ", quote(word), " in place of a number"));
    }
    return *value;
  }
  void expect_end() {
    do {
      if (!take_word(lines_.line()).empty()) fail("something follows the last element");
    } while (lines_.next());
  }
  [[noreturn]] void fail(const std::string& fault) const { lines_.fail(fault); }

 private:
  Lines lines_;
};

// The data as binary, in the machine's byte order or the opposite.
template <std::endian Order>
class BinarySource {
 public:
  BinarySource(const Lines& lines, std::string_view bytes, std::string name)
      : bytes_(bytes), at_(bytes.size() - lines.rest().size()), name_(std::move(name)) {}

  double next(Type type) {
    switch (type) {
      case Type::i8:
        return take<std::int8_t>();
      case Type::u8:
        return take<std::uint8_t>();
      case Type::i16:
        return take<std::int16_t>();
      case Type::u16:
        return take<std::uint16_t>();
      case Type::i32:
        return take<std::int32_t>();
      case Type::u32:
        return take<std::uint32_t>();
      case Type::f32:
        return static_cast<double>(take<float>());
      case Type::f64:
        break;
    }
    return take<double>();
  }
  void expect_end() const {
    for (std::size_t i = at_; i < bytes_.size(); ++i) {
      if (!is_space(bytes_[i])) fail(text(bytes_.size() - at_, " bytes follow the last element"));
    }
  }
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(text("'", name_, "' byte ", at_, ": ", fault));
  }

 private:
  template <class T>
  T take() {
    if (bytes_.size() - at_ < sizeof(T)) fail("the file ends too early");
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    if constexpr (Order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  std::size_t at_;
  std::string name_;
};

template <class Source>
std::uint64_t list_length(Source& source, const Property& property) {
  const double length = source.next(property.count_type);
  if (length < 0 || length > std::numeric_limits<std::uint32_t>::max()) {
    source.fail(text("a list of length ", length));
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
      source.fail(text("vertices have no coordinate ", name));
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
  std::vector<VertexId> corners;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (i != indices) {
        skip_property(source, property);
        continue;
      }
      const std::uint64_t size = list_length(source, property);
      if (size < 3) source.fail(text("facet ", f, " has ", size, " corners"));
      corners.clear();
      for (std::uint64_t c = 0; c < size; ++c) {
        const double corner = source.next(property.type);
        if (!(corner >= 0 && corner < static_cast<double>(vertices))) {
          source.fail(text("corner ", c, " of facet ", f, " is ", corner, ", not one of ", vertices,
                           " vertices"));
        }
        corners.emplace_back(static_cast<std::uint32_t>(corner));
      }
      mesh.add_polygon(corners);
    }
  }
}

template <class Source>
MeshParts read_elements(Source source, const Header& header) {
  MeshParts mesh;
  mesh.comments = header.comments;
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const Element& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) source.fail("there is no element 'vertex'");
  if (vertex->count > kMostVertices) source.fail(text(vertex->count, " vertices are too many"));
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

MeshParts parse_ply(std::string_view bytes, const std::string& name) {
  Lines lines(bytes, name);
  const Header header = parse_header(lines);
  switch (header.encoding) {
    case Encoding::ascii:
      return read_elements(WordSource(lines), header);
    case Encoding::little_endian:
      return read_elements(BinarySource<std::endian::little>(lines, bytes, name), header);
    case Encoding::big_endian:
      break;
  }
  return read_elements(BinarySource<std::endian::big>(lines, bytes, name), header);
}

}  // namespace deliso
