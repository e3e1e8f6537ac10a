// SPDX-License-Identifier: MIT
// VTK's XML files ("VTK File Formats", XML formats): the markup tag by tag, and what stands in a
// DataArray. An array holds text, or base64 in its place, or stands behind all markup (raw or
// base64); each binary one with its length in front, or compressed in blocks as
// vtkZLibDataCompressor cuts them.
//
// Memory follows what the file holds: an array is decoded only where its own header promises
// exactly the bytes that are wanted, and the file has enough for them.
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

// The next tag at or behind `from`; processing instructions are passed over, and so are comments,
// which `comments`, when given, keeps.
XmlTag next_tag(std::string_view text, std::size_t from,
                std::vector<std::string_view>* comments = nullptr);

// Whether the first tag is VTK's.
bool looks_like_vtk_xml(std::string_view text);

// All of these throw InputError in the name of the bytes.
class VtkXml {
 public:
  // pre: the bytes look like VTK's XML, and outlive this. `type` is what the file must hold,
  // `use` what only that can be: "ImageData", "can be meshed".
  VtkXml(const Bytes& bytes, std::string_view type, std::string_view use);

  // The next tag of the markup; its name is empty where that ends.
  XmlTag next();

  std::endian byte_order() const { return byte_order_; }
  // What stands before the root.
  const std::vector<std::string_view>& comments() const { return comments_; }

  // The number in an attribute; `missing` where there is none.
  std::uint64_t count(const XmlTag& tag, std::string_view name, std::uint64_t missing) const;

  bool is_text(const XmlTag& array) const;
  // What stands between the array's tag and the next.
  Bytes inside(const XmlTag& array) const;
  // The bytes of an array that is not text. It must have `size` of them; `what` needs them. pre:
  // next() has come to the end.
  Bytes binary(const XmlTag& array, std::uint64_t size, const std::string& what) const;

 private:
  Bytes from_base64(std::string_view text, std::uint64_t size, const std::string& what) const;
  Bytes from_block(const Bytes& data, std::uint64_t size, const std::string& what) const;
  Bytes from_blocks(const Bytes& data, std::uint64_t size, const std::string& what) const;
  std::uint64_t header_word(std::span<const std::byte> bytes, std::size_t n) const;
  [[noreturn]] void fail(const std::string& fault) const { deliso::fail(bytes_.name, fault); }

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
