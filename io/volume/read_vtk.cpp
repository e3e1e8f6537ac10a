// SPDX-License-Identifier: MIT
// VTK's legacy format with a STRUCTURED_POINTS data set ("VTK File Formats", simple legacy
// formats): keyword lines, and arrays as numbers in text or as big-endian binary. Only the header
// of an array shows its end, so earlier arrays are skipped by their size.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/volume/foreign_formats.h"
#include "io/volume/named_arrays.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

// Returns VTK's own names of types as those of other formats.
std::string plain_type(std::string_view type) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"long", "int64"},
      {"unsigned_long", "uint64"},
      {"vtktypeint64", "int64"},
      {"vtktypeuint64", "uint64"},
  };
  for (const auto& [name, plain] : kNames) {
    if (lower(type) == name) return std::string(plain);
  }
  return std::string(type);
}

// Attributes "KEYWORD name type", and their values per point.
struct Attribute {
  std::string_view keyword;
  std::uint64_t components;
};
constexpr Attribute kAttributes[] = {{"vectors", 3},   {"normals", 3},    {"tensors", 9},
                                     {"tensors6", 6},  {"global_ids", 1}, {"pedigree_ids", 1},
                                     {"edge_flags", 1}};

class VtkParser {
 public:
  explicit VtkParser(const VolumeInput& input)
      : input_(input), text_(input.bytes.text()), grid_(grid_of(input)) {}

  Volume run() {
    text_.line();  // the magic
    text_.line();  // a title
    const std::string storage = lower(text_.word());
    if (storage != "ascii" && storage != "binary")
      fail(input_.name(), "is neither ASCII nor BINARY but ", quote(storage));
    binary_ = storage == "binary";
    grid_.byte_order = std::endian::big;
    read_structure();
    try {
      read_arrays();
    } catch (const InputError&) {
      if (!has_wanted()) throw;  // a fault after the array to read does not matter
    }
    const std::size_t chosen = choose_array(input_, arrays_, "");
    grid_.type = supported_type(input_, arrays_[chosen].type);
    Bytes data = input_.bytes.from(starts_[chosen]);
    if (!binary_) return volume_from_text(grid_, data, true);
    const std::uint64_t size = data_size(grid_);
    if (data.size() > size) data = data.first(static_cast<std::size_t>(size));
    return volume_from_raw(grid_, data);
  }

 private:
  std::string keyword() {
    std::string word = lower(text_.word());
    if (word.empty()) fail(input_.name(), "ends before the samples");
    return word;
  }
  void expect(const char* wanted) {
    const std::string word = keyword();
    if (word != wanted)
      fail(input_.name(), "has ", quote(word), " where ", quote(wanted), " is expected");
  }
  std::int64_t integer(const char* what) {
    const std::string_view word = text_.word();
    const std::optional<std::int64_t> value = to_int(word);
    if (!value) fail(input_.name(), what, " is ", quote(word), ", not an integer");
    return *value;
  }
  std::uint64_t count(const char* what) {
    const std::int64_t value = integer(what);
    if (value < 0) fail(input_.name(), what, " is ", value);
    return static_cast<std::uint64_t>(value);
  }
  double real(const char* what) {
    const std::string_view word = text_.word();
    const std::optional<double> value = to_double(word);
    if (!value) fail(input_.name(), what, " is ", quote(word), ", not a number");
    return *value;
  }
  Vec3 vector(const char* what) {
    const double x = real(what), y = real(what);
    return {x, y, real(what)};
  }

  // Reads everything before POINT_DATA.
  void read_structure() {
    expect("dataset");
    const std::string kind = keyword();
    if (kind != "structured_points")
      fail(input_.name(), "holds a data set of kind ", quote(kind),
           ", not STRUCTURED_POINTS: ", conversion_by_vtk(kVtkReader, kVtkResample));
    Vec3 spacing{1, 1, 1};
    std::uint64_t cells = 0;
    for (std::string word = keyword(); word != "point_data"; word = keyword()) {
      if (word == "dimensions") {
        for (std::int64_t& n : grid_.dims) n = integer("DIMENSIONS");
      } else if (word == "spacing" || word == "aspect_ratio") {
        spacing = vector("SPACING");
      } else if (word == "origin") {
        grid_.origin = vector("ORIGIN");
      } else if (word == "cell_data") {
        cells = count("CELL_DATA");
      } else {
        read_attribute(word, cells, false);
        if (cells > 0 && trimmed(text_.rest()).empty()) refuse_cells(input_.name(), kVtkReader);
      }
    }
    grid_.set_spacing(spacing);
    data_size(grid_);
    const std::int64_t points = integer("POINT_DATA"),
                       n = grid_.dims[0] * grid_.dims[1] * grid_.dims[2];
    if (points != n)
      fail(input_.name(), "POINT_DATA is ", points, ", but DIMENSIONS give ", n, " points");
  }

  // Finds the beginnings of the arrays of POINT_DATA.
  void read_arrays() {
    const auto points = static_cast<std::uint64_t>(grid_.dims[0] * grid_.dims[1] * grid_.dims[2]);
    for (std::string word = lower(text_.word()); !word.empty() && word != "cell_data";
         word = lower(text_.word())) {
      read_attribute(word, points, true);
    }
    if (arrays_.empty()) fail(input_.name(), "ends before the samples");
  }

  // True if there is an array that choose_array can choose, or refuse by its name.
  bool has_wanted() const {
    const std::optional<std::string>& name = input_.options.array;
    return name ? std::ranges::find(arrays_, *name, &NamedArray::name) != arrays_.end()
                : !arrays_.empty();
  }

  // Skips the section that `word` opens, with its data: one or several arrays of `tuples` tuples, a
  // table of colors, or metadata of the array before. Notes arrays of points.
  void read_attribute(const std::string& word, std::uint64_t tuples, bool of_points) {
    const auto simple = std::ranges::find(kAttributes, word, &Attribute::keyword);
    if (word == "metadata") {  // up to an empty line
      text_.line();
      while (!text_.at_end() && !trimmed(text_.line()).empty()) {
      }
    } else if (word == "scalars") {
      std::string name(text_.word());
      const std::vector<std::string_view> rest = words_of(text_.line());
      const std::string type(rest.empty() ? "" : rest[0]);
      const auto components = rest.size() > 1 ? number_in<std::uint64_t>(rest[1]) : 1;
      expect("lookup_table");
      pass({std::move(name), type, components.value_or(0)}, tuples, of_points);
    } else if (word == "color_scalars") {  // bytes; fractions of 1 in text
      std::string name(text_.word());
      const std::uint64_t components = count("the number of components");
      pass({std::move(name), binary_ ? "unsigned_char" : "COLOR_SCALARS in ASCII", components},
           tuples, of_points);
    } else if (word == "lookup_table") {
      text_.word();  // the name
      pass({"", "unsigned_char", 4}, count("the size of a LOOKUP_TABLE"), false);
    } else if (word == "texture_coordinates") {
      std::string name(text_.word());
      const std::uint64_t components = count("the number of components");
      pass({std::move(name), std::string(text_.word()), components}, tuples, of_points);
    } else if (simple != std::end(kAttributes)) {
      std::string name(text_.word());
      pass({std::move(name), std::string(text_.word()), simple->components}, tuples, of_points);
    } else if (word == "field") {
      text_.word();  // the field's name
      read_field(count("the number of arrays"), tuples, of_points);
    } else {
      fail(input_.name(), "keyword ", quote(word), " is not supported");
    }
  }

  // Reads "name components tuples type" and the data, once per array.
  void read_field(std::uint64_t arrays, std::uint64_t tuples, bool of_points) {
    for (std::uint64_t n = 0; n < arrays; ++n) {
      std::string name(text_.word());
      if (lower(name) == "metadata") {
        read_attribute("metadata", 0, false);
        name = text_.word();
      }
      if (name.empty()) fail(input_.name(), "ends after ", n, " of ", arrays, " arrays");
      if (name == "NULL_ARRAY") continue;
      const std::uint64_t components = count("the number of components");
      const std::uint64_t own = count("the number of tuples");
      pass({std::move(name), std::string(text_.word()), components}, own,
           of_points && own == tuples);
    }
  }

  // Notes an array whose data begins on the next line, and skips it.
  void pass(NamedArray array, std::uint64_t tuples, bool of_points) {
    text_.line();
    array.type = plain_type(array.type);
    if (of_points) {
      arrays_.push_back(array);
      starts_.push_back(text_.position());
    }
    const auto ends = [&] { fail(input_.name(), "ends within its array ", quote(array.name)); };
    std::optional<StoredType> type = sample_type_named(array.type);
    if (array.type == "COLOR_SCALARS in ASCII") type = SampleType::u8;
    if (lower(array.type) == "vtkidtype") type = SampleType::i32;  // as VTK stores it here
    if (!type)
      fail(input_.name(), "array ", quote(array.name), " is of type ", quote(array.type),
           ", which is not supported");
    // A value has a byte at least.
    const std::uint64_t rest = text_.rest().size();
    if (array.components != 0 && tuples > rest / array.components) ends();
    const std::uint64_t values = tuples * array.components;
    if (binary_) {
      if (values > rest / size_of(*type)) ends();
      text_.skip(static_cast<std::size_t>(values * size_of(*type)));
      return;
    }
    for (std::uint64_t n = 0; n < values; ++n) {
      if (text_.word().empty()) ends();
    }
  }

  const VolumeInput& input_;
  TextCursor text_;
  SampleGrid grid_;
  bool binary_ = false;
  std::vector<NamedArray> arrays_;
  std::vector<std::size_t> starts_;  // of their data, in the file
};

}  // namespace

bool looks_like_vtk(const Bytes& bytes) {
  return bytes.text().starts_with("# vtk DataFile");
}

Volume read_vtk(const VolumeInput& input) {
  return VtkParser(input).run();
}

}  // namespace deliso
