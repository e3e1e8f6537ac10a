// SPDX-License-Identifier: MIT
// NRRD, by teem's "Definition of NRRD File Format". A magic line is first, then lines "field:
// value", an empty line, and the data. The data may also be in another file.
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

class NrrdHeader {
 public:
  explicit NrrdHeader(const VolumeInput& input) : input_(input) {
    TextCursor text(input.bytes.text());
    text.line();  // the magic
    while (!text.at_end()) {
      const std::string_view line = text.line();
      if (line.empty()) break;
      if (line[0] == '#') continue;
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos)
        fail(input.name(), "header line " + quote(line) + " is no 'field: value'");
      if (line.substr(colon).starts_with(":=")) continue;  // a key of the user's
      std::string field = lower(trimmed(line.substr(0, colon)));
      std::erase(field, ' ');
      fields_[field] = trimmed(line.substr(colon + 1));
      if (field == "datafile" && fields_[field].starts_with("LIST")) break;  // file names follow
    }
    data_offset_ = text.position();
  }

  bool has(const std::string& field) const { return fields_.contains(field); }
  // Returns the field's value, or `fallback` if it is missing; null: that is an error.
  std::string_view get(const std::string& field, const char* fallback = nullptr) const {
    const auto found = fields_.find(field);
    if (found != fields_.end()) return found->second;
    if (!fallback) fail(input_.name(), "the header has no field '" + field + "'");
    return fallback;
  }
  [[noreturn]] void fail_field(const std::string& field, const std::string& fault) const {
    fail(input_.name(), "field '" + field + "' is " + quote(get(field, "")) + ": " + fault);
  }
  std::int64_t integer(const std::string& field, const char* fallback = nullptr) const {
    const std::optional<std::int64_t> value = to_int(get(field, fallback));
    if (!value) fail_field(field, "not an integer");
    return *value;
  }
  // One number per axis.
  std::vector<double> per_axis(const std::string& field, std::size_t axes) const {
    const std::optional<std::vector<double>> values = to_doubles(get(field));
    if (!values || values->size() != axes)
      fail_field(field, "not " + std::to_string(axes) + " numbers");
    return *values;
  }
  std::size_t data_offset() const { return data_offset_; }

 private:
  const VolumeInput& input_;
  std::map<std::string, std::string_view> fields_;
  std::size_t data_offset_ = 0;
};

// Parses "(1,0,0) none (0,1,0)" as vectors; nullopt where the axis is not spatial.
std::optional<std::vector<std::optional<Vec3>>> parse_vectors(std::string_view text) {
  std::vector<std::optional<Vec3>> vectors;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    if (starts_with_ignoring_case(text, "none")) {
      vectors.emplace_back(std::nullopt);
      text.remove_prefix(4);
      continue;
    }
    const std::size_t close = text.find(')');
    if (text[0] != '(' || close == std::string_view::npos) return std::nullopt;
    std::string list(text.substr(1, close - 1));
    for (char& c : list)
      if (c == ',') c = ' ';
    const std::optional<std::vector<double>> numbers = to_doubles(list);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    vectors.emplace_back(Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]});
    text.remove_prefix(close + 1);
  }
  return vectors;
}

// Returns the three axes of the samples. Of more than three, axes of size 1 are dropped, the last
// ones first.
std::vector<std::size_t> spatial_axes(const VolumeInput& input, const NrrdHeader& header,
                                      const std::vector<std::int64_t>& sizes) {
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) axes.push_back(axis);
  for (std::size_t n = axes.size(); n-- > 0 && axes.size() > 3;)
    if (sizes[axes[n]] == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(n));
  if (axes.size() != 3) {
    fail(input.name(), "sizes " + quote(header.get("sizes")) + " are " +
                           std::to_string(sizes.size()) +
                           "-dimensional: only three-dimensional scalar volumes can be meshed");
  }
  return axes;
}

void read_space(const VolumeInput& input, const NrrdHeader& header, SampleGrid& grid) {
  const std::string space = lower(header.get("space", ""));
  if (space == "ras" || space.starts_with("right-anterior-superior"))
    grid.space = AnatomicalSpace::ras;
  else if (space == "lps" || space.starts_with("left-posterior-superior"))
    grid.space = AnatomicalSpace::lps;
  else if (space == "las" || space.starts_with("left-anterior-superior"))
    input.note(
        "coordinates are in the file's left-anterior-superior space, which viewers of "
        "meshes do not expect");
}

// Spacing, origin and directions of the three axes.
void read_geometry(const VolumeInput& input, const NrrdHeader& header,
                   const std::vector<std::size_t>& axes, std::size_t dimension, SampleGrid& grid) {
  read_space(input, header, grid);
  if (header.has("spacedirections")) {
    const auto vectors = parse_vectors(header.get("spacedirections"));
    if (!vectors || vectors->size() != dimension)
      header.fail_field("spacedirections",
                        "not " + std::to_string(dimension) + " vectors of three numbers");
    for (std::size_t n = 0; n < 3; ++n) {
      if (!(*vectors)[axes[n]]) header.fail_field("spacedirections", "an axis is not spatial");
      grid.steps[n] = *(*vectors)[axes[n]];
    }
    if (header.has("spaceorigin")) {
      const auto origin = parse_vectors(header.get("spaceorigin"));
      if (!origin || origin->size() != 1 || !origin->front())
        header.fail_field("spaceorigin", "not a vector of three numbers");
      grid.origin = *origin->front();
    }
    return;
  }

  Vec3 spacing{1, 1, 1};
  const std::vector<std::string_view> centers = words_of(header.get("centers", ""));
  const auto is_cell = [&](std::size_t axis) {
    return axis < centers.size() && lower(centers[axis]) == "cell";
  };
  if (header.has("spacings")) {
    const std::vector<double> values = header.per_axis("spacings", dimension);
    for (int n = 0; n < 3; ++n) spacing[n] = values[axes[static_cast<std::size_t>(n)]];
  } else if (header.has("axismins") && header.has("axismaxs")) {
    const std::vector<double> mins = header.per_axis("axismins", dimension);
    const std::vector<double> maxs = header.per_axis("axismaxs", dimension);
    for (int n = 0; n < 3; ++n) {
      const std::size_t axis = axes[static_cast<std::size_t>(n)];
      const std::int64_t steps = grid.dims[static_cast<std::size_t>(n)] - (is_cell(axis) ? 0 : 1);
      spacing[n] = (maxs[axis] - mins[axis]) / static_cast<double>(steps);
    }
  }
  grid.set_spacing(spacing);
  if (!header.has("axismins")) return;
  const std::vector<double> mins = header.per_axis("axismins", dimension);
  for (int n = 0; n < 3; ++n) {
    const std::size_t axis = axes[static_cast<std::size_t>(n)];
    grid.origin[n] = mins[axis] + (is_cell(axis) ? spacing[n] / 2 : 0);
  }
}

SampleGrid read_grid(const VolumeInput& input, const NrrdHeader& header) {
  SampleGrid grid = grid_of(input);
  grid.type = supported_type(input, header.get("type"));
  const std::int64_t dimension = header.integer("dimension");
  const std::optional<std::vector<std::int64_t>> sizes = to_ints(header.get("sizes"));
  if (!sizes) header.fail_field("sizes", "not a list of integers");
  if (static_cast<std::int64_t>(sizes->size()) != dimension)
    header.fail_field("sizes", "not " + std::to_string(dimension) + " numbers as 'dimension' says");
  const std::vector<std::size_t> axes = spatial_axes(input, header, *sizes);
  for (std::size_t n = 0; n < 3; ++n) grid.dims[n] = (*sizes)[axes[n]];
  data_size(grid);
  read_geometry(input, header, axes, sizes->size(), grid);
  return grid;
}

Bytes find_data(const VolumeInput& input, const NrrdHeader& header) {
  if (!header.has("datafile")) return input.bytes.from(header.data_offset());
  const std::string_view file = header.get("datafile");
  if (file.starts_with("LIST") || file.find('%') != std::string_view::npos)
    header.fail_field("datafile", "data spread over several files is not supported");
  return open_data_file(input, file);
}

}  // namespace

bool looks_like_nrrd(const Bytes& bytes) {
  return bytes.text().starts_with("NRRD000");
}

Volume read_nrrd(const VolumeInput& input) {
  const NrrdHeader header(input);
  SampleGrid grid = read_grid(input, header);
  const std::string encoding = lower(header.get("encoding"));
  const bool raw = encoding == "raw";
  const bool gzip = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "ascii" || encoding == "text" || encoding == "txt";
  if (!raw && !gzip && !text)
    header.fail_field("encoding", "only raw, gzip and ascii are supported");

  if (!text && size_of(grid.type) > 1) {
    const std::string endian = lower(header.get("endian"));
    if (endian != "little" && endian != "big") header.fail_field("endian", "not little or big");
    grid.byte_order = endian == "big" ? std::endian::big : std::endian::little;
  }

  Bytes data = find_data(input, header);
  const std::int64_t lines = header.integer("lineskip", "0");
  if (lines < 0) header.fail_field("lineskip", "negative");
  TextCursor cursor(data.text());
  for (std::int64_t n = 0; n < lines; ++n) {
    if (cursor.at_end())
      fail(data.name, "has fewer than " + std::to_string(lines) + " lines to skip");
    cursor.line();
  }
  data = data.from(cursor.position());

  const std::int64_t skip = header.integer("byteskip", "0");
  if (skip < -1 || (skip == -1 && !raw)) header.fail_field("byteskip", "cannot be followed");
  if (gzip)
    return volume_from_compressed(grid, data, Wrapping::gzip, static_cast<std::uint64_t>(skip));
  const std::uint64_t size = data_size(grid);
  if (skip == -1) {  // the data is at the end
    if (data.size() > size) data = data.from(data.size() - static_cast<std::size_t>(size));
  } else {
    if (static_cast<std::uint64_t>(skip) > data.size())
      fail(data.name, "has " + std::to_string(data.size()) + " bytes, fewer than the " +
                          std::to_string(skip) + " to skip");
    data = data.from(static_cast<std::size_t>(skip));
  }
  return text ? volume_from_text(grid, data, false) : volume_from_raw(grid, data);
}

}  // namespace deliso
