// SPDX-License-Identifier: MIT
// NRRD, by teem's "Definition of NRRD File Format". A magic line is first, then lines "field:
// value", an empty line, and the data. The data may also be in another file.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/files/text_scan.h"
#include "io/volume/header_fields.h"
#include "io/volume/sample_grid.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

struct NrrdHeader : HeaderFields {
  explicit NrrdHeader(const Bytes& bytes) : HeaderFields(bytes.name, "field") {
    TextCursor text(bytes.text());
    text.line();  // the magic
    while (!text.at_end()) {
      const std::string_view line = text.line();
      if (line.empty()) break;
      if (line[0] == '#') continue;
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos)
        fail(bytes.name, "header line ", quote(line), " is no 'field: value'");
      if (line.substr(colon).starts_with(":=")) {
        keys[std::string(line.substr(0, colon))] = trimmed(line.substr(colon + 2));
        continue;
      }
      std::string field(line.substr(0, colon));
      std::erase(field, ' ');
      set(field, line.substr(colon + 1));
      // The names of files follow.
      if (lower(trimmed(field)) == "datafile" && get(field).starts_with("LIST")) break;
    }
    data_offset = text.position();
  }

  std::map<std::string, std::string_view> keys;  // of the user's
  std::size_t data_offset = 0;
};

// Parses "(1,0,0) none (0,1,0)" as vectors; nullopt where the axis is not spatial.
std::optional<std::vector<std::optional<Vec3>>> parse_vectors(std::string_view text) {
  std::vector<std::optional<Vec3>> vectors;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    if (lower(text.substr(0, 4)) == "none") {
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

constexpr std::size_t kMostNrrdAxes = 16;  // of teem

// The axes of the data, and those of space among them.
struct NrrdAxes {
  std::vector<DataAxis> all;
  std::vector<std::size_t> of_space;
};

// Tells which axes are of space. Of more than three these are left out: axes that the header calls
// something else, then axes of size 1, then any; the last ones first. An axis that is left out
// counts times if its kind is time, or if it has none and is not the first; else channels.
NrrdAxes axes_of(const VolumeInput& input, const NrrdHeader& header,
                 const std::vector<std::int64_t>& sizes) {
  using Kind = DataAxis::Kind;
  const std::vector<std::string_view> kinds = words_of(header.get("kinds", ""));
  const auto vectors = parse_vectors(header.get("spacedirections", ""));
  const auto kind_of = [&](std::size_t axis) {
    std::string kind = axis < kinds.size() ? lower(kinds[axis]) : "";
    if (!kind.empty() && kind != "domain" && kind != "space" && kind[0] != '?' && kind != "none")
      return kind;
    const bool has_none = vectors && axis < vectors->size() && !(*vectors)[axis];
    return std::string(has_none ? "none" : "");
  };
  NrrdAxes axes;
  for (std::size_t axis = 0; axis < std::min(sizes.size(), kMostNrrdAxes); ++axis) {
    axes.of_space.push_back(axis);
    axes.all.push_back({Kind::x, sizes[axis]});
  }
  const auto drop = [&](auto is_dropped) {
    for (std::size_t n = axes.of_space.size(); n-- > 0 && axes.of_space.size() > 3;) {
      const std::size_t axis = axes.of_space[n];
      if (!is_dropped(axis)) continue;
      const std::string kind = kind_of(axis);
      const bool has_kind = !kind.empty() && kind != "none";
      const bool is_time = has_kind ? kind == "time" : axis > 0;
      axes.all[axis].kind = is_time ? Kind::time : Kind::channel;
      axes.of_space.erase(axes.of_space.begin() + static_cast<std::ptrdiff_t>(n));
    }
  };
  drop([&](std::size_t axis) { return !kind_of(axis).empty(); });
  drop([&](std::size_t axis) { return sizes[axis] == 1; });
  drop([](std::size_t) { return true; });
  const auto has_several = [&](Kind kind) {
    return std::ranges::count_if(
        axes.all, [&](const DataAxis& axis) { return axis.kind == kind && axis.size != 1; });
  };
  if (sizes.size() < 3 || sizes.size() > kMostNrrdAxes || has_several(Kind::time) > 1 ||
      has_several(Kind::channel) > 1) {
    fail(input.name(), "sizes ", quote(header.get("sizes")), " are ", sizes.size(),
         "-dimensional: only three-dimensional scalar volumes can be meshed");
  }
  for (const Kind kind : {Kind::x, Kind::y, Kind::z}) {
    axes.all[axes.of_space[static_cast<std::size_t>(kind)]].kind = kind;
  }
  std::erase_if(axes.all,
                [](const DataAxis& axis) { return axis.kind > Kind::z && axis.size == 1; });
  return axes;
}

void read_space(const VolumeInput& input, const NrrdHeader& header, SampleGrid& grid) {
  const std::string space = lower(header.get("space", ""));
  if (space == "ras" || space.starts_with("right-anterior-superior"))
    grid.space = AnatomicalSpace::ras;
  else if (space == "lps" || space.starts_with("left-posterior-superior"))
    grid.space = AnatomicalSpace::lps;
  else if (space == "las" || space.starts_with("left-anterior-superior"))
    input.warn("space-las",
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
      header.fail_field("spacedirections", "not ", dimension, " vectors of three numbers");
    for (std::size_t n = 0; n < 3; ++n) {
      if (!(*vectors)[axes[n]]) header.fail_field("spacedirections", "an axis is not spatial");
      grid.steps[n] = *(*vectors)[axes[n]];
    }
    if (header.has("spaceorigin") && !grid.read.origin) {
      const auto origin = parse_vectors(header.get("spaceorigin"));
      if (!origin || origin->size() != 1 || !origin->front())
        header.fail_field("spaceorigin", "not a vector of three numbers");
      grid.origin = *origin->front();
    }
    return;
  }

  Vec3 spacing = grid.read.spacing.value_or(Vec3{1, 1, 1});
  const std::vector<std::string_view> centers = words_of(header.get("centers", ""));
  const auto is_cell = [&](std::size_t axis) {
    return axis < centers.size() && lower(centers[axis]) == "cell";
  };
  if (grid.read.spacing) {
    // It stands for all that the header has.
  } else if (header.has("spacings")) {
    const std::vector<double> values = *header.numbers({"spacings"}, dimension);
    for (int n = 0; n < 3; ++n) spacing[n] = values[axes[static_cast<std::size_t>(n)]];
  } else if (header.has("axismins") && header.has("axismaxs")) {
    const std::vector<double> mins = *header.numbers({"axismins"}, dimension);
    const std::vector<double> maxs = *header.numbers({"axismaxs"}, dimension);
    for (int n = 0; n < 3; ++n) {
      const std::size_t axis = axes[static_cast<std::size_t>(n)];
      const std::int64_t steps = grid.dims[static_cast<std::size_t>(n)] - (is_cell(axis) ? 0 : 1);
      spacing[n] = (maxs[axis] - mins[axis]) / static_cast<double>(steps);
    }
  }
  grid.set_spacing(spacing);
  if (!header.has("axismins")) return;
  const std::vector<double> mins = *header.numbers({"axismins"}, dimension);
  for (int n = 0; n < 3; ++n) {
    const std::size_t axis = axes[static_cast<std::size_t>(n)];
    grid.origin[n] = mins[axis] + (is_cell(axis) ? spacing[n] / 2 : 0);
  }
}

// Returns the color in three shares of red, green and blue.
std::optional<std::array<std::uint8_t, 3>> color_in(std::string_view shares) {
  const auto numbers = to_doubles(shares);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  std::array<std::uint8_t, 3> color{};
  for (std::size_t n = 0; n < color.size(); ++n) {
    if (!((*numbers)[n] >= 0 && (*numbers)[n] <= 1)) return std::nullopt;
    color[n] = static_cast<std::uint8_t>(std::lround(255 * (*numbers)[n]));
  }
  return color;
}

// Returns the segments of a segmentation as Slicer saves it. In files before its version 4.11 each
// has a layer of its own, with the label 1.
std::vector<NamedSegment> segments_of(const NrrdHeader& header) {
  std::vector<NamedSegment> segments;
  for (std::int64_t n = 0;; ++n) {
    const std::string start = "Segment" + std::to_string(n) + "_";
    const auto name = header.keys.find(start + "Name");
    if (name == header.keys.end()) return segments;
    const auto number = [&](const char* key, std::int64_t fallback) {
      const auto found = header.keys.find(start + key);
      return found == header.keys.end() ? fallback : to_int(found->second).value_or(fallback);
    };
    const auto color = header.keys.find(start + "Color");
    segments.push_back({std::string(name->second), number("LabelValue", 1), number("Layer", n) + 1,
                        color == header.keys.end() ? std::nullopt : color_in(color->second)});
  }
}

SampleGrid read_grid(const VolumeInput& input, const NrrdHeader& header) {
  SampleGrid grid = grid_of(input);
  grid.type = supported_type(input, header.get("type"));
  const std::int64_t dimension = header.integer("dimension");
  const std::optional<std::vector<std::int64_t>> sizes = to_ints(header.get("sizes"));
  if (!sizes) header.fail_field("sizes", "not a list of integers");
  if (static_cast<std::int64_t>(sizes->size()) != dimension)
    header.fail_field("sizes", "not ", dimension, " numbers as 'dimension' says");
  const NrrdAxes axes = axes_of(input, header, *sizes);
  if ((*sizes)[0] <= 4 && sizes->size() == 3 && !header.has("kinds") && !header.has("space")) {
    input.note("may-be-color", "its sizes are ", header.get("sizes"),
               ", without kinds: taken as a volume, though it may be a picture in color");
  }
  const std::vector<NamedSegment> named = segments_of(header);
  const std::string segments =
      joined(named, ", ", [](const NamedSegment& segment) { return quote(segment.name); });
  set_axes(grid, axes.all, segments.empty() ? "" : "; --label NAME chooses one of " + segments);
  if (!segments.empty())
    input.note("segments-named", "names segments, which --label takes: ", segments);
  std::ranges::copy_if(named, std::back_inserter(input.log.segments), [&](const NamedSegment& s) {
    return input.options.channel.value_or(s.channel) == s.channel;
  });
  read_geometry(input, header, axes.of_space, sizes->size(), grid);
  return grid;
}

Bytes find_data(const VolumeInput& input, const NrrdHeader& header) {
  if (!header.has("datafile")) return input.bytes.from(header.data_offset);
  const std::string_view file = header.get("datafile");
  if (file.starts_with("LIST") || file.find('%') != std::string_view::npos)
    header.fail_field("datafile", "data spread over several files is not supported");
  return open_data_file(input, file);
}

}  // namespace

std::vector<NamedSegment> segments_of_nrrd(const Bytes& bytes) {
  return segments_of(NrrdHeader(bytes));
}

bool looks_like_nrrd(const Bytes& bytes) {
  return bytes.text().starts_with("NRRD000");
}

Volume read_nrrd(const VolumeInput& input) {
  const NrrdHeader header(input.bytes);
  SampleGrid grid = read_grid(input, header);
  const std::string encoding = lower(header.get("encoding"));
  const bool raw = encoding == "raw";
  const bool gzip = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "ascii" || encoding == "text" || encoding == "txt";
  if (!raw && !gzip && !text)
    header.fail_field("encoding",
                      "only raw, gzip and ascii are supported: convert it with 'unu save -f nrrd "
                      "-e gzip -i FILE -o volume.nrrd' (of Teem; Debian has teem-unu)");

  if (!text && size_of(grid.type) > 1) {
    const std::string endian = lower(header.get("endian"));
    if (endian != "little" && endian != "big") header.fail_field("endian", "not little or big");
    grid.byte_order = endian == "big" ? std::endian::big : std::endian::little;
  }

  Bytes data = find_data(input, header);
  const std::int64_t lines = header.integer("lineskip", 0);
  if (lines < 0) header.fail_field("lineskip", "negative");
  TextCursor cursor(data.text());
  for (std::int64_t n = 0; n < lines; ++n) {
    if (cursor.at_end()) fail(data.name, "has fewer than ", lines, " lines to skip");
    cursor.line();
  }
  data = data.from(cursor.position());

  const std::int64_t skip = header.integer("byteskip", 0);
  if (skip < -1 || (skip == -1 && !raw)) header.fail_field("byteskip", "cannot be followed");
  if (gzip)
    return volume_from_compressed(grid, data, Wrapping::gzip, static_cast<std::uint64_t>(skip));
  data = data_behind(grid, data, skip, "to skip");
  return text ? volume_from_text(grid, data, false) : volume_from_raw(grid, data);
}

}  // namespace deliso
