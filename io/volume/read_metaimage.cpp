// SPDX-License-Identifier: MIT
// MetaImage (MetaIO): lines "Key = Value". The last one, ElementDataFile, has the place of the
// data: LOCAL (after the line) or a file.
#include <array>
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

struct MetaHeader : HeaderFields {
  explicit MetaHeader(const Bytes& bytes) : HeaderFields(bytes.name, "key") {
    TextCursor text(bytes.text());
    while (!text.at_end() && !has("ElementDataFile")) {
      const std::string_view line = text.line();
      const std::size_t equals = line.find('=');
      if (equals != std::string_view::npos) {
        set(line.substr(0, equals), line.substr(equals + 1));
      } else if (!trimmed(line).empty()) {
        fail(bytes.name, "header line ", quote(line), " is no 'Key = Value'");
      }
    }
    data_offset = text.position();
  }

  bool is_true(std::initializer_list<std::string_view> spellings, bool fallback) const {
    const std::string_view value = find(spellings).value_or("");
    return value.empty() ? fallback : value[0] == 'T' || value[0] == 't' || value[0] == '1';
  }

  std::size_t data_offset = 0;
};

// MetaIO's long types have four bytes on every machine.
StoredType element_type(const VolumeInput& input, std::string_view name) {
  if (name == "MET_LONG") return SampleType::i32;
  if (name == "MET_ULONG") return SampleType::u32;
  return supported_type(input, name);
}

// Sets the steps: spacing times the axes' directions, which are the rows of TransformMatrix.
void read_geometry(const MetaHeader& header, std::size_t dimension, SampleGrid& grid) {
  Vec3 spacing{1, 1, 1};
  if (!grid.read.spacing) {
    if (const auto values = header.numbers({"ElementSpacing", "ElementSize"}, dimension))
      spacing = {(*values)[0], (*values)[1], (*values)[2]};
  }
  grid.set_spacing(spacing);
  if (const auto matrix =
          header.numbers({"TransformMatrix", "Rotation", "Orientation"}, dimension * dimension)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* row = matrix->data() + axis * dimension;
      // The diagonal holds the spacing, or NaN if that is not positive.
      grid.steps[axis] = grid.steps[axis][static_cast<int>(axis)] * Vec3{row[0], row[1], row[2]};
    }
  }
  if (!grid.read.origin) {
    if (const auto origin = header.numbers({"Offset", "Position", "Origin"}, dimension))
      grid.origin = {(*origin)[0], (*origin)[1], (*origin)[2]};
  }
  grid.space = AnatomicalSpace::lps;
}

SampleGrid read_grid(const VolumeInput& input, const MetaHeader& header) {
  SampleGrid grid = grid_of(input);
  grid.type = element_type(input, header.get("ElementType"));
  grid.byte_order = header.is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false)
                        ? std::endian::big
                        : std::endian::little;
  const std::int64_t dimension = header.integer("NDims");
  const std::optional<std::vector<std::int64_t>> sizes = to_ints(header.get("DimSize"));
  if (!sizes || static_cast<std::int64_t>(sizes->size()) != dimension)
    header.fail_field("DimSize", "not ", dimension, " integers as NDims says");
  bool is_known = sizes->size() >= 3;
  for (std::size_t n = 4; n < sizes->size(); ++n) is_known &= (*sizes)[n] == 1;
  if (!is_known)
    header.fail_field("DimSize",
                      "only three-dimensional volumes, at one time or several, can be meshed");
  const std::int64_t channels = header.integer("ElementNumberOfChannels", 1);
  using Kind = DataAxis::Kind;
  set_axes(grid, std::array{DataAxis{Kind::channel, channels}, DataAxis{Kind::x, (*sizes)[0]},
                            DataAxis{Kind::y, (*sizes)[1]}, DataAxis{Kind::z, (*sizes)[2]},
                            DataAxis{Kind::time, sizes->size() > 3 ? (*sizes)[3] : 1}});
  read_geometry(header, sizes->size(), grid);
  return grid;
}

}  // namespace

bool looks_like_metaimage(const Bytes& bytes) {
  // A text whose first line has one of the keys with which writers begin.
  const std::string_view line = TextCursor(bytes.text().substr(0, 4096)).line();
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string key = lower(trimmed(line.substr(0, equals)));
  for (const char* known : {"objecttype", "ndims", "comment", "objectsubtype", "transformtype",
                            "name", "id", "dimsize", "elementtype"})
    if (key == known) return true;
  return false;
}

Volume read_metaimage(const VolumeInput& input) {
  const MetaHeader header(input.bytes);
  const SampleGrid grid = read_grid(input, header);
  const std::string_view file = header.get("ElementDataFile");
  if (file == "LIST" || file.find('%') != std::string_view::npos)
    header.fail_field("ElementDataFile", "data spread over several files is not supported");
  const bool local = file == "LOCAL" || file == "Local" || file == "local";
  Bytes data = local ? input.bytes.from(header.data_offset) : open_data_file(input, file);

  const std::int64_t skip = header.integer("HeaderSize", 0);
  const bool compressed = header.is_true({"CompressedData"}, false);
  if (skip < -1 || (skip == -1 && compressed))
    header.fail_field("HeaderSize", "cannot be followed");
  data = data_behind(grid, data, skip, "of its header");
  if (compressed) {
    const bool gzip = data.text().starts_with("\x1f\x8b");
    return volume_from_compressed(grid, data, gzip ? Wrapping::gzip : Wrapping::zlib, 0);
  }
  return header.is_true({"BinaryData"}, true) ? volume_from_raw(grid, data)
                                              : volume_from_text(grid, data, false);
}

}  // namespace deliso
