// SPDX-License-Identifier: MIT
// VTK's XML format for images ("VTK File Formats", XML formats; ImageData with one piece). The
// samples stand in the DataArray's text (as numbers, or base64) or behind all markup (raw or
// base64), each block with its length in front; compressed blocks as vtkZLibDataCompressor cuts
// them.
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/base64.h"
#include "files/inflate.h"
#include "files/text_scan.h"
#include "volume/sample_grid.h"
#include "volume/volume_formats.h"

namespace deliso {
namespace {

struct Tag {
  std::string_view name;  // "/PointData" for a closing tag; empty at the end
  std::string_view attributes;
  std::size_t end = 0;  // offset behind '>'

  std::optional<std::string_view> attribute(std::string_view wanted) const {
    std::string_view rest = attributes;
    for (;;) {
      const std::size_t equals = rest.find('=');
      if (equals == std::string_view::npos) return std::nullopt;
      const std::string_view key = trimmed(rest.substr(0, equals));
      rest = trimmed(rest.substr(equals + 1));
      if (rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return std::nullopt;
      const std::size_t close = rest.find(rest[0], 1);
      if (close == std::string_view::npos) return std::nullopt;
      if (key == wanted) return rest.substr(1, close - 1);
      rest.remove_prefix(close + 1);
    }
  }
};

// The next tag at or behind `from`; comments and processing instructions are passed over.
Tag next_tag(std::string_view text, std::size_t from) {
  for (;;) {
    const std::size_t open = text.find('<', from);
    if (open == std::string_view::npos) return {};
    const bool comment = text.substr(open).starts_with("<!--");
    const std::size_t close = text.find(comment ? "-->" : ">", open);
    if (close == std::string_view::npos) return {};
    from = close + (comment ? 3 : 1);
    if (comment || text[open + 1] == '?' || text[open + 1] == '!') continue;
    std::string_view inside = text.substr(open + 1, close - open - 1);
    if (inside.ends_with('/')) inside.remove_suffix(1);
    std::size_t length = 0;
    while (length < inside.size() && !is_space(inside[length])) ++length;
    return {inside.substr(0, length), inside.substr(length), from};
  }
}

class VtiParser {
 public:
  explicit VtiParser(const VolumeInput& input) : input_(input), text_(input.bytes.text()) {}

  Volume run() {
    read_structure();
    data_size(grid_, input_.name());
    const std::string format = lower(array_.attribute("format").value_or("ascii"));
    const std::size_t end = std::min(text_.find('<', array_.end), text_.size());
    const std::string_view inside = text_.substr(array_.end, end - array_.end);
    if (format == "ascii") {
      const Bytes all = input_.bytes.from(array_.end);
      return volume_from_text(grid_, all.first(inside.size()), false);
    }
    if (format == "binary") return from_base64(inside);
    if (format == "appended") return from_appended();
    fail(input_.name(), "a DataArray has format " + quote(format) +
                            ": only ascii, binary and appended are supported");
  }

 private:
  std::vector<double> numbers(const Tag& tag, const char* name, std::size_t count) const {
    const std::string_view text = tag.attribute(name).value_or("");
    const std::optional<std::vector<double>> values = to_doubles(text);
    if (!values || values->size() != count)
      fail(input_.name(), std::string("attribute ") + name + " is " + quote(text) + ", not " +
                              std::to_string(count) + " numbers");
    return *values;
  }

  void read_root(const Tag& tag) {
    const std::string_view type = tag.attribute("type").value_or("");
    if (type != "ImageData")
      fail(input_.name(),
           "is a VTK file of type " + quote(type) + ": only ImageData can be meshed");
    grid_.byte_order = tag.attribute("byte_order").value_or("LittleEndian") == "BigEndian"
                           ? std::endian::big
                           : std::endian::little;
    const std::string_view header = tag.attribute("header_type").value_or("UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail(input_.name(), "header_type " + quote(header) + " is not supported");
    header_size_ = header == "UInt64" ? 8 : 4;
    const std::string_view compressor = tag.attribute("compressor").value_or("");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail(input_.name(),
           "compressor " + quote(compressor) + " is not supported (vtkZLibDataCompressor is)");
    compressed_ = !compressor.empty();
  }

  void read_image(const Tag& tag) {
    if (tag.attribute("Spacing")) {
      const std::vector<double> s = numbers(tag, "Spacing", 3);
      grid_.set_spacing({s[0], s[1], s[2]});
    }
    if (tag.attribute("Origin")) {
      const std::vector<double> o = numbers(tag, "Origin", 3);
      grid_.origin = {o[0], o[1], o[2]};
    }
    if (tag.attribute("Direction")) {  // row by row; the axes are its columns
      const std::vector<double> d = numbers(tag, "Direction", 9);
      for (std::size_t a = 0; a < 3; ++a)
        grid_.steps[a] = grid_.steps[a][static_cast<int>(a)] * Vec3{d[a], d[a + 3], d[a + 6]};
    }
  }

  // Extents are the first and last index along each axis; index (0,0,0) lies at the origin.
  void read_extent(const Tag& tag, const char* name) {
    const std::string_view text = tag.attribute(name).value_or("");
    const std::optional<std::vector<std::int64_t>> e = to_ints(text);
    constexpr std::int64_t limit = std::int64_t{1} << 40;
    bool valid = e && e->size() == 6;
    for (std::size_t n = 0; valid && n < 6; ++n) valid = (*e)[n] > -limit && (*e)[n] < limit;
    if (!valid)
      fail(input_.name(), std::string(name) + " is " + quote(text) + ", not six integers");
    for (std::size_t a = 0; a < 3; ++a) {
      grid_.dims[a] = (*e)[2 * a + 1] - (*e)[2 * a] + 1;
      start_[a] = static_cast<double>((*e)[2 * a]);
    }
  }

  // Walks the markup up to the data: the image, its piece, the array.
  void read_structure() {
    Tag tag = next_tag(text_, 0);
    if (tag.name != "VTKFile") fail(input_.name(), "is no VTK XML file");
    read_root(tag);
    std::string_view active;  // the array that PointData names
    bool in_points = false;
    int pieces = 0;
    while (!(tag = next_tag(text_, tag.end)).name.empty() && tag.name != "AppendedData") {
      if (tag.name == "ImageData") {
        read_image(tag);
        read_extent(tag, "WholeExtent");
      } else if (tag.name == "Piece") {
        if (++pieces > 1) fail(input_.name(), "has several pieces: only one is supported");
        if (tag.attribute("Extent")) read_extent(tag, "Extent");
      } else if (tag.name == "PointData" || tag.name == "/PointData") {
        in_points = tag.name == "PointData";
        if (in_points) active = tag.attribute("Scalars").value_or("");
      } else if (tag.name == "DataArray" && in_points) {
        if (array_.name.empty() || (!active.empty() && tag.attribute("Name") == active))
          array_ = tag;
      }
    }
    if (tag.name == "AppendedData") appended_ = tag;
    if (array_.name.empty()) fail(input_.name(), "has no array of point data");
    for (std::size_t a = 0; a < 3; ++a) grid_.origin = grid_.origin + start_[a] * grid_.steps[a];
    grid_.roi = input_.options.roi;
    grid_.type = supported_type(input_, array_.attribute("type").value_or(""));
    const std::string_view components = array_.attribute("NumberOfComponents").value_or("1");
    if (components != "1")
      fail(input_.name(),
           "has " + quote(components) + " components per point: only scalar volumes can be meshed");
  }

  std::uint64_t header_word(std::span<const std::byte> bytes, std::size_t n) const {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < header_size_; ++b) {
      const std::size_t from = grid_.byte_order == std::endian::little ? b : header_size_ - 1 - b;
      value |= std::to_integer<std::uint64_t>(bytes[n * header_size_ + from]) << (8 * b);
    }
    return value;
  }

  Volume from_appended() {
    if (appended_.name.empty()) fail(input_.name(), "has no AppendedData");
    const std::string_view encoding = appended_.attribute("encoding").value_or("base64");
    std::size_t start = appended_.end;
    while (start < text_.size() && is_space(text_[start])) ++start;
    if (start == text_.size() || text_[start] != '_')
      fail(input_.name(), "has no '_' before its appended data");
    ++start;
    const std::string_view text = array_.attribute("offset").value_or("");
    const std::optional<std::int64_t> offset = to_int(text);
    if (!offset || *offset < 0) fail(input_.name(), "attribute offset is " + quote(text));
    if (static_cast<std::uint64_t>(*offset) > text_.size() - start)
      fail(input_.name(), "ends before its array at offset " + std::to_string(*offset));
    const Bytes data = input_.bytes.from(start + static_cast<std::size_t>(*offset));
    if (encoding == "raw") return compressed_ ? from_blocks(data) : from_block(data);
    if (encoding == "base64") return from_base64(data.text());
    fail(input_.name(), "encoding " + quote(encoding) + " is not supported");
  }

  // Only as much is decoded as the array's own header asks for.
  Volume from_base64(std::string_view text) {
    std::uint64_t size = data_size(grid_, input_.name());
    if (compressed_) {
      const std::vector<std::byte> first = decode_base64(text, header_size_);
      const std::uint64_t blocks = first.size() < header_size_ ? 0 : header_word(first, 0);
      size = (3 + std::min<std::uint64_t>(blocks, text.size())) * header_size_;
      const std::vector<std::byte> sizes = decode_base64(text, static_cast<std::size_t>(size));
      for (std::size_t n = 3; (n + 1) * header_size_ <= sizes.size(); ++n)
        size += std::min<std::uint64_t>(header_word(sizes, n), text.size());
    } else {
      size += header_size_;
    }
    size = std::min<std::uint64_t>(size, text.size());
    auto decoded = std::make_shared<const std::vector<std::byte>>(
        decode_base64(text, static_cast<std::size_t>(size)));
    const Bytes data{input_.name(), *decoded, decoded};
    return compressed_ ? from_blocks(data) : from_block(data);
  }

  // A length and so many bytes.
  Volume from_block(const Bytes& data) {
    if (data.size() < header_size_) fail(input_.name(), "ends before its samples");
    const std::uint64_t length = header_word(data.data, 0);
    const std::uint64_t size = data_size(grid_, input_.name());
    if (length != size)
      fail(input_.name(), describe(grid_) + " need " + std::to_string(size) +
                              " bytes, the array holds " + std::to_string(length));
    Bytes samples = data.from(header_size_);
    if (samples.size() > size) samples = samples.first(static_cast<std::size_t>(size));
    return volume_from_raw(grid_, samples);
  }

  // Number of blocks, size of each before compression, of the last if it is smaller (else 0), their
  // sizes after compression; then the blocks.
  Volume from_blocks(const Bytes& data) {
    if (data.size() < 3 * header_size_) fail(input_.name(), "ends before its samples");
    const std::uint64_t blocks = header_word(data.data, 0), block = header_word(data.data, 1),
                        last = header_word(data.data, 2);
    const std::uint64_t size = data_size(grid_, input_.name());
    if (blocks > data.size() / header_size_ - 3) fail(input_.name(), "ends before its samples");
    const std::uint64_t whole = last == 0 ? blocks : blocks - 1;
    if (blocks == 0 || last > block || (block > 0 && whole > size / block) ||
        whole * block + last != size) {
      fail(input_.name(), describe(grid_) + " need " + std::to_string(size) + " bytes, " +
                              std::to_string(blocks) + " blocks of " + std::to_string(block) +
                              " bytes and a rest of " + std::to_string(last) + " do not give that");
    }
    if (size > largest_inflated(data.size())) fail(input_.name(), "ends before its samples");
    Buffer buffer(static_cast<std::size_t>(size));
    std::size_t from = static_cast<std::size_t>((3 + blocks) * header_size_), to = 0;
    for (std::size_t n = 0; n < blocks; ++n) {
      const std::uint64_t length = header_word(data.data, 3 + n);
      const std::string which = "block " + std::to_string(n) + " of " + std::to_string(blocks);
      if (length > data.size() - from) fail(input_.name(), "ends within " + which);
      const std::size_t expected = static_cast<std::size_t>(n < whole ? block : last);
      const Inflated result = inflate(data.data.subspan(from, static_cast<std::size_t>(length)),
                                      Wrapping::zlib, buffer.span().subspan(to, expected));
      if (result.fault) fail(input_.name(), which + " is damaged: " + result.fault);
      if (!result.ended || result.size != expected)
        fail(input_.name(), which + " does not hold " + std::to_string(expected) + " bytes");
      from += static_cast<std::size_t>(length);
      to += expected;
    }
    return volume_from_raw(grid_, bytes_of(std::move(buffer), input_.name()));
  }

  const VolumeInput& input_;
  std::string_view text_;
  SampleGrid grid_;
  std::array<double, 3> start_{};  // the first sample's index
  Tag array_, appended_;
  std::size_t header_size_ = 4;
  bool compressed_ = false;
};

}  // namespace

bool looks_like_vti(const Bytes& bytes) {
  return next_tag(bytes.text().substr(0, 4096), 0).name == "VTKFile";
}

Volume read_vti(const VolumeInput& input) {
  return VtiParser(input).run();
}

}  // namespace deliso
