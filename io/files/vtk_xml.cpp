// SPDX-License-Identifier: MIT
#include "io/files/vtk_xml.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "io/files/base64.h"
#include "io/files/field_reader.h"
#include "io/files/inflate.h"
#include "io/files/text_scan.h"

namespace deliso {

std::optional<std::string_view> XmlTag::attribute(std::string_view wanted) const {
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

XmlTag next_tag(std::string_view text, std::size_t from, std::vector<std::string_view>* comments) {
  for (;;) {
    const std::size_t open = text.find('<', from);
    if (open == std::string_view::npos) return {};
    const bool comment = text.substr(open).starts_with("<!--");
    const std::size_t close = text.find(comment ? "-->" : ">", open);
    if (close == std::string_view::npos) return {};
    from = close + (comment ? 3 : 1);
    if (comment && comments != nullptr && close >= open + 4)
      comments->push_back(text.substr(open + 4, close - open - 4));
    if (comment || text[open + 1] == '?' || text[open + 1] == '!') continue;
    std::string_view inside = text.substr(open + 1, close - open - 1);
    if (inside.ends_with('/')) inside.remove_suffix(1);
    std::size_t length = 0;
    while (length < inside.size() && !is_space(inside[length])) ++length;
    return {inside.substr(0, length), inside.substr(length), from};
  }
}

bool looks_like_vtk_xml(std::string_view text) {
  return next_tag(text.substr(0, 4096), 0).name == "VTKFile";
}

VtkXml::VtkXml(const Bytes& bytes, std::string_view type, std::string_view use)
    : bytes_(bytes), text_(bytes.text()), tag_(next_tag(text_, 0, &comments_)) {
  if (tag_.name != "VTKFile") fail("is no VTK XML file");
  const std::string_view found = tag_.attribute("type").value_or("");
  if (found != type) fail("is a VTK file of type ", quote(found), ": only ", type, " ", use);
  byte_order_ = tag_.attribute("byte_order").value_or("LittleEndian") == "BigEndian"
                    ? std::endian::big
                    : std::endian::little;
  const std::string_view header = tag_.attribute("header_type").value_or("UInt32");
  if (header != "UInt32" && header != "UInt64")
    fail("header_type ", quote(header), " is not supported");
  header_size_ = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = tag_.attribute("compressor").value_or("");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    fail("compressor ", quote(compressor), " is not supported (vtkZLibDataCompressor is)");
  compressed_ = !compressor.empty();
}

XmlTag VtkXml::next() {
  do {
    tag_ = next_tag(text_, tag_.end);
  } while (tag_.name == "InformationKey" || tag_.name == "Value");  // VTK's notes in an array
  // The bytes after AppendedData need not be markup.
  if (tag_.name == "AppendedData") appended_ = std::exchange(tag_, {{}, {}, text_.size()});
  if (tag_.name.empty()) tag_.end = text_.size();
  return tag_;
}

std::uint64_t VtkXml::count(const XmlTag& tag, std::string_view name, std::uint64_t missing) const {
  const std::optional<std::string_view> words = tag.attribute(name);
  if (!words) return missing;
  const auto value = number_in<std::uint64_t>(trimmed(*words));
  if (!value) fail("attribute ", name, " is ", quote(*words));
  return *value;
}

bool VtkXml::is_text(const XmlTag& array) const {
  return lower(array.attribute("format").value_or("ascii")) == "ascii";
}

Bytes VtkXml::inside(const XmlTag& array) const {
  const std::size_t end = std::min(text_.find('<', array.end), text_.size());
  return bytes_.from(array.end).first(end - array.end);
}

Bytes VtkXml::binary(const XmlTag& array, std::uint64_t size, const std::string& what) const {
  const std::string format = lower(array.attribute("format").value_or("ascii"));
  if (format == "binary") return from_base64(inside(array).text(), size, what);
  if (format != "appended")
    fail("a DataArray has format ", quote(format),
         ": only ascii, binary and appended are supported");
  if (appended_.name.empty()) fail("has no AppendedData");
  const std::string_view encoding = appended_.attribute("encoding").value_or("base64");
  std::size_t start = appended_.end;
  while (start < text_.size() && is_space(text_[start])) ++start;
  if (start == text_.size() || text_[start] != '_') fail("has no '_' before its appended data");
  ++start;
  if (!array.attribute("offset")) fail("an appended DataArray has no offset");
  const std::uint64_t offset = count(array, "offset", 0);
  if (offset > text_.size() - start) fail("ends before its array at offset ", offset);
  const Bytes data = bytes_.from(start + static_cast<std::size_t>(offset));
  if (encoding == "base64") return from_base64(data.text(), size, what);
  if (encoding != "raw") fail("encoding ", quote(encoding), " is not supported");
  return compressed_ ? from_blocks(data, size, what) : from_block(data, size, what);
}

std::uint64_t VtkXml::header_word(std::span<const std::byte> bytes, std::size_t n) const {
  const FieldReader words(bytes, byte_order_);
  return header_size_ == 8 ? words.get<std::uint64_t>(8 * n) : words.get<std::uint32_t>(4 * n);
}

// Decodes only the bytes that the array's own header promises.
Bytes VtkXml::from_base64(std::string_view text, std::uint64_t size,
                          const std::string& what) const {
  std::uint64_t coded = size;
  if (compressed_) {
    const std::vector<std::byte> first = decode_base64(text, header_size_);
    const std::uint64_t blocks = first.size() < header_size_ ? 0 : header_word(first, 0);
    coded = (3 + std::min<std::uint64_t>(blocks, text.size())) * header_size_;
    const std::vector<std::byte> sizes = decode_base64(text, static_cast<std::size_t>(coded));
    for (std::size_t n = 3; (n + 1) * header_size_ <= sizes.size(); ++n)
      coded += std::min<std::uint64_t>(header_word(sizes, n), text.size());
  } else {
    coded += header_size_;
  }
  coded = std::min<std::uint64_t>(coded, text.size());
  auto decoded = std::make_shared<const std::vector<std::byte>>(
      decode_base64(text, static_cast<std::size_t>(coded)));
  const Bytes data{bytes_.name, *decoded, decoded};
  return compressed_ ? from_blocks(data, size, what) : from_block(data, size, what);
}

// Reads a length, then that number of bytes.
Bytes VtkXml::from_block(const Bytes& data, std::uint64_t size, const std::string& what) const {
  if (data.size() < header_size_) fail("ends before ", what);
  const std::uint64_t length = header_word(data.data, 0);
  if (length != size) fail(what, " need ", size, " bytes, the array holds ", length);
  const Bytes rest = data.from(header_size_);
  if (rest.size() < size)
    fail("data is too short: ", what, " need ", size, " bytes, found ", rest.size());
  return rest.first(static_cast<std::size_t>(size));
}

// Reads the number of blocks, the size of each before compression, that of the last if it is
// smaller (else 0), and the sizes after compression. The blocks follow.
Bytes VtkXml::from_blocks(const Bytes& data, std::uint64_t size, const std::string& what) const {
  if (data.size() < header_size_) fail("ends before ", what);
  const std::uint64_t blocks = header_word(data.data, 0);
  if (blocks == 0 && size == 0) return {bytes_.name, {}, nullptr};
  if (data.size() < 3 * header_size_ || blocks > data.size() / header_size_ - 3)
    fail("ends before ", what);
  const std::uint64_t block = header_word(data.data, 1), last = header_word(data.data, 2);
  const std::uint64_t whole = last == 0 ? blocks : blocks - 1;
  if (blocks == 0 || last > block || (block > 0 && whole > size / block) ||
      whole * block + last != size) {
    fail(what, " need ", size, " bytes, ", blocks, " blocks of ", block, " bytes and a rest of ",
         last, " do not give that");
  }
  if (size > largest_inflated(data.size())) fail("ends before ", what);
  Buffer buffer(static_cast<std::size_t>(size));
  std::size_t from = static_cast<std::size_t>((3 + blocks) * header_size_), to = 0;
  for (std::size_t n = 0; n < blocks; ++n) {
    const std::uint64_t length = header_word(data.data, 3 + n);
    const std::string which = text("block ", n, " of ", blocks);
    if (length > data.size() - from) fail("ends within ", which);
    const auto expected = static_cast<std::size_t>(n < whole ? block : last);
    const Inflated result = inflate(data.data.subspan(from, static_cast<std::size_t>(length)),
                                    Wrapping::zlib, buffer.span().subspan(to, expected));
    if (result.fault) fail(which, " is damaged: ", result.fault);
    if (!result.ended || result.size != expected)
      fail(which, " does not hold ", expected, " bytes");
    from += static_cast<std::size_t>(length);
    to += expected;
  }
  return bytes_of(std::move(buffer), bytes_.name);
}

}  // namespace deliso
