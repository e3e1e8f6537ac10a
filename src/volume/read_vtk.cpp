// SPDX-License-Identifier: MIT
// VTK's legacy format with a STRUCTURED_POINTS data set ("VTK File Formats", simple legacy
// formats): keyword lines, then the samples as numbers in text or as big-endian binary.
#include <optional>
#include <string>

#include "files/text_scan.h"
#include "volume/sample_grid.h"
#include "volume/volume_formats.h"

namespace deliso {
namespace {

class VtkParser {
 public:
  explicit VtkParser(const VolumeInput& input) : input_(input), text_(input.bytes.text()) {}

  Volume run() {
    text_.line();  // the magic
    text_.line();  // a title
    const std::string storage = lower(text_.word());
    if (storage != "ascii" && storage != "binary")
      fail(input_.name(), "is neither ASCII nor BINARY but " + quote(storage));
    binary_ = storage == "binary";
    grid_.roi = input_.options.roi;
    grid_.byte_order = std::endian::big;
    read_structure();
    read_array_header();
    data_size(grid_, input_.name());
    Bytes data = input_.bytes.from(text_.position());
    if (!binary_) return volume_from_text(grid_, data, true);
    // Other arrays and metadata may follow.
    const std::uint64_t size = data_size(grid_, data.name);
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
      fail(input_.name(), "has " + quote(word) + " where " + quote(wanted) + " is expected");
  }
  std::int64_t integer(const char* what) {
    const std::string_view word = text_.word();
    const std::optional<std::int64_t> value = to_int(word);
    if (!value) fail(input_.name(), std::string(what) + " is " + quote(word) + ", not an integer");
    return *value;
  }
  double real(const char* what) {
    const std::string_view word = text_.word();
    const std::optional<double> value = to_double(word);
    if (!value) fail(input_.name(), std::string(what) + " is " + quote(word) + ", not a number");
    return *value;
  }
  Vec3 vector(const char* what) {
    const double x = real(what), y = real(what);
    return {x, y, real(what)};
  }

  // Everything up to POINT_DATA.
  void read_structure() {
    expect("dataset");
    const std::string kind = keyword();
    if (kind != "structured_points")
      fail(input_.name(),
           "holds a data set of kind " + quote(kind) + ": only STRUCTURED_POINTS can be meshed");
    Vec3 spacing{1, 1, 1};
    for (std::string word = keyword(); word != "point_data"; word = keyword()) {
      if (word == "dimensions") {
        for (std::int64_t& n : grid_.dims) n = integer("DIMENSIONS");
      } else if (word == "spacing" || word == "aspect_ratio") {
        spacing = vector("SPACING");
      } else if (word == "origin") {
        grid_.origin = vector("ORIGIN");
      } else {
        fail(input_.name(), "keyword " + quote(word) + " before POINT_DATA is not supported");
      }
    }
    grid_.set_spacing(spacing);
    data_size(grid_, input_.name());
    const std::int64_t points = integer("POINT_DATA"),
                       n = grid_.dims[0] * grid_.dims[1] * grid_.dims[2];
    if (points != n)
      fail(input_.name(), "POINT_DATA is " + std::to_string(points) + ", but DIMENSIONS give " +
                              std::to_string(n) + " points");
  }

  // "SCALARS name type [components]" with its look-up table, "COLOR_SCALARS name components" (what
  // VTK calls bytes without a name), or the first array of a FIELD.
  void read_array_header() {
    const std::string word = keyword();
    std::int64_t components = 1;
    if (word == "scalars") {
      text_.word();  // the name
      const std::vector<std::string_view> rest = words_of(text_.line());
      grid_.type = supported_type(input_, rest.empty() ? "" : rest[0]);
      if (rest.size() > 1) components = to_int(rest[1]).value_or(0);
      expect("lookup_table");
    } else if (word == "color_scalars") {
      if (!binary_) fail(input_.name(), "COLOR_SCALARS in ASCII are not supported");
      text_.word();  // the name
      components = integer("the number of components");
      grid_.type = SampleType::u8;
    } else if (word == "field") {
      text_.word();  // the field's name
      text_.word();  // how many arrays
      text_.word();  // the array's name
      components = integer("the number of components");
      integer("the number of tuples");
      grid_.type = supported_type(input_, text_.word());
    } else {
      fail(input_.name(), "has " + quote(word) + " where SCALARS or FIELD is expected");
    }
    if (components != 1)
      fail(input_.name(), "has " + std::to_string(components) +
                              " components per point: only scalar volumes can be meshed");
    text_.line();
  }

  const VolumeInput& input_;
  TextCursor text_;
  SampleGrid grid_;
  bool binary_ = false;
};

}  // namespace

bool looks_like_vtk(const Bytes& bytes) {
  return bytes.text().starts_with("# vtk DataFile");
}

Volume read_vtk(const VolumeInput& input) {
  return VtkParser(input).run();
}

}  // namespace deliso
