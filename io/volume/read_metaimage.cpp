// SPDX-License-Identifier: MIT
// MetaImage (MetaIO): lines "Key = Value". The last one, ElementDataFile, has the place of the
// data: LOCAL (after the line) or a file.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

class MetaHeader {
 public:
  explicit MetaHeader(const VolumeInput& input) : input_(input) {
    TextCursor text(input.bytes.text());
    while (!text.at_end()) {
      const std::string_view line = text.line();
      const std::size_t equals = line.find('=');
      if (equals == std::string_view::npos) {
        if (trimmed(line).empty()) continue;
        fail(input.name(), "header line " + quote(line) + " is no 'Key = Value'");
      }
      const std::string key = lower(trimmed(line.substr(0, equals)));
      keys_[key] = trimmed(line.substr(equals + 1));
      if (key == "elementdatafile") break;
    }
    data_offset_ = text.position();
  }

  bool has(const std::string& key) const { return keys_.contains(key); }
  // Returns the value of the first of these spellings that the header has.
  std::optional<std::string_view> find(std::initializer_list<const char*> spellings) const {
    for (const char* key : spellings)
      if (const auto found = keys_.find(lower(key)); found != keys_.end()) return found->second;
    return std::nullopt;
  }
  std::string_view get(const char* key) const {
    const std::optional<std::string_view> value = find({key});
    if (!value) fail(input_.name(), std::string("the header has no key '") + key + "'");
    return *value;
  }
  bool is_true(std::initializer_list<const char*> spellings, bool fallback) const {
    const std::optional<std::string_view> value = find(spellings);
    if (!value || value->empty()) return fallback;
    return (*value)[0] == 'T' || (*value)[0] == 't' || (*value)[0] == '1';
  }
  std::int64_t integer(const char* key) const {
    const std::optional<std::int64_t> value = to_int(get(key));
    if (!value) fail_key(key, get(key), "not an integer");
    return *value;
  }
  // Returns `count` numbers; nullopt if the header has no such key.
  std::optional<std::vector<double>> numbers(std::initializer_list<const char*> spellings,
                                             std::size_t count) const {
    const std::optional<std::string_view> text = find(spellings);
    if (!text) return std::nullopt;
    std::optional<std::vector<double>> values = to_doubles(*text);
    if (!values || values->size() != count)
      fail_key(*spellings.begin(), *text, "not " + std::to_string(count) + " numbers");
    return values;
  }
  [[noreturn]] void fail_key(const char* key, std::string_view value,
                             const std::string& fault) const {
    fail(input_.name(), std::string("key '") + key + "' is " + quote(value) + ": " + fault);
  }
  std::size_t data_offset() const { return data_offset_; }

 private:
  const VolumeInput& input_;
  std::map<std::string, std::string_view> keys_;
  std::size_t data_offset_ = 0;
};

// MetaIO's long types have four bytes on every machine.
SampleType element_type(const VolumeInput& input, std::string_view name) {
  if (name == "MET_LONG") return SampleType::i32;
  if (name == "MET_ULONG") return SampleType::u32;
  return supported_type(input, name);
}

// Sets the steps: spacing times the axes' directions, which are the rows of TransformMatrix.
void read_geometry(const MetaHeader& header, std::size_t dimension, SampleGrid& grid) {
  Vec3 spacing{1, 1, 1};
  if (const auto values = header.numbers({"ElementSpacing", "ElementSize"}, dimension))
    spacing = {(*values)[0], (*values)[1], (*values)[2]};
  grid.set_spacing(spacing);
  if (const auto matrix =
          header.numbers({"TransformMatrix", "Rotation", "Orientation"}, dimension * dimension)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* row = matrix->data() + axis * dimension;
      // The diagonal holds the spacing, or NaN if that is not positive.
      grid.steps[axis] = grid.steps[axis][static_cast<int>(axis)] * Vec3{row[0], row[1], row[2]};
    }
  }
  if (const auto origin = header.numbers({"Offset", "Position", "Origin"}, dimension))
    grid.origin = {(*origin)[0], (*origin)[1], (*origin)[2]};
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
    header.fail_key("DimSize", header.get("DimSize"),
                    "not " + std::to_string(dimension) + " integers as NDims says");
  bool is_known = sizes->size() >= 3;
  for (std::size_t n = 4; n < sizes->size(); ++n) is_known &= (*sizes)[n] == 1;
  if (!is_known)
    header.fail_key("DimSize", header.get("DimSize"),
                    "only three-dimensional volumes, at one time or several, can be meshed");
  const std::int64_t channels =
      header.has("elementnumberofchannels") ? header.integer("ElementNumberOfChannels") : 1;
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
  const MetaHeader header(input);
  const SampleGrid grid = read_grid(input, header);
  const std::string_view file = header.get("ElementDataFile");
  if (file == "LIST" || file.find('%') != std::string_view::npos)
    header.fail_key("ElementDataFile", file, "data spread over several files is not supported");
  const bool local = file == "LOCAL" || file == "Local" || file == "local";
  Bytes data = local ? input.bytes.from(header.data_offset()) : open_data_file(input, file);

  const std::int64_t skip = header.has("headersize") ? header.integer("HeaderSize") : 0;
  const std::uint64_t size = data_size(grid);
  const bool compressed = header.is_true({"CompressedData"}, false);
  if (skip < -1 || (skip == -1 && compressed))
    header.fail_key("HeaderSize", header.get("HeaderSize"), "cannot be followed");
  if (skip == -1) {  // the data is at the end
    if (data.size() > size) data = data.from(data.size() - static_cast<std::size_t>(size));
  } else if (skip > 0) {
    if (static_cast<std::uint64_t>(skip) > data.size())
      fail(data.name, "has " + std::to_string(data.size()) + " bytes, fewer than the " +
                          std::to_string(skip) + " of its header");
    data = data.from(static_cast<std::size_t>(skip));
  }

  if (compressed) {
    const bool gzip = data.text().starts_with("\x1f\x8b");
    return volume_from_compressed(grid, data, gzip ? Wrapping::gzip : Wrapping::zlib, 0);
  }
  return header.is_true({"BinaryData"}, true) ? volume_from_raw(grid, data)
                                              : volume_from_text(grid, data, false);
}

}  // namespace deliso
