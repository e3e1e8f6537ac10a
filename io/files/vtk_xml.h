// SPDX-License-Identifier: MIT
// VTK's XML files ("VTK File Formats", XML formats): the markup tag by tag, and the contents of a
// DataArray. An array has text or base64 in its place, or raw bytes or base64 after all markup. A
// binary one begins with its length, or with the sizes of its blocks by vtkZLibDataCompressor.
//
// Memory is bounded by the file's size. An array is decoded only if its own header promises exactly
// the expected bytes, and the file has enough for them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"

namespace deliso {

struct XmlTag {
  std::string_view name;  // "/PointData" for a closing tag; empty at the end
  std::string_view attributes;
  std::size_t end = 0;  // offset behind '>'

  std::optional<std::string_view> attribute(std::string_view wanted) const;
};

// Returns the next tag at or after `from`. Skips processing instructions and comments. `comments`,
// if given, receives the latter.
XmlTag next_tag(std::string_view text, std::size_t from,
                std::vector<std::string_view>* comments = nullptr);

// True if the first tag is VTK's.
bool looks_like_vtk_xml(std::string_view text);

// A VTK XML file. All of its functions throw InputErrors with the name of the bytes.
class VtkXml {
 public:
  // `type`: the required type of the file, as "ImageData". `use`: why, as "can be meshed". Keeps a
  // reference to the bytes. pre: they look like VTK's XML.
  VtkXml(const Bytes& bytes, std::string_view type, std::string_view use);

  // Returns the next tag of the markup, with an empty name at its end.
  XmlTag next();

  std::endian byte_order() const { return byte_order_; }
  // Returns the comments before the root.
  const std::vector<std::string_view>& comments() const { return comments_; }

  // Returns the number in an attribute; `missing` if there is none.
  std::uint64_t count(const XmlTag& tag, std::string_view name, std::uint64_t missing) const;

  bool is_text(const XmlTag& array) const;
  // Returns the bytes between the array's tag and the next tag.
  Bytes inside(const XmlTag& array) const;
  // Returns the bytes of an array that is not text. It must have `size` of them, for `what`. pre:
  // next() has reached the end.
  Bytes binary(const XmlTag& array, std::uint64_t size, const std::string& what) const;

 private:
  Bytes from_base64(std::string_view text, std::uint64_t size, const std::string& what) const;
  Bytes from_block(const Bytes& data, std::uint64_t size, const std::string& what) const;
  Bytes from_blocks(const Bytes& data, std::uint64_t size, const std::string& what) const;
  std::uint64_t header_word(std::span<const std::byte> bytes, std::size_t n) const;
  [[noreturn]] void fail(const auto&... fault) const { deliso::fail(bytes_.name, fault...); }

  const Bytes& bytes_;
  std::string_view text_;
  std::vector<std::string_view> comments_;
  XmlTag tag_;       // where next() is
  XmlTag appended_;  // nothing follows it
  std::endian byte_order_ = std::endian::little;
  std::size_t header_size_ = 4;
  bool compressed_ = false;
};

}  // namespace deliso
