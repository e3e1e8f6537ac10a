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
#include <type_traits>
#include <vector>

#include "base/vec3.h"
#include "io/files/field_reader.h"
#include "io/files/input_file.h"
#include "io/files/text_scan.h"

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
  // Calls take(value) for each of an array's `count` numbers. `what`: their use, for messages. pre:
  // as of binary(); count * 8 fits.
  template <class As, class Take>
  void for_each(const XmlTag& array, std::uint64_t count, const std::string& what,
                Take take) const {
    const std::string_view type = array.attribute("type").value_or("");
    const auto each = [&]<class T>(T) { for_each_of<T, As>(array, count, what, take); };
    if (type == "Float32") return each(float{});
    if (type == "Float64") return each(double{});
    if (type == "Int8") return each(std::int8_t{});
    if (type == "UInt8") return each(std::uint8_t{});
    if (type == "Int16") return each(std::int16_t{});
    if (type == "UInt16") return each(std::uint16_t{});
    if (type == "Int32") return each(std::int32_t{});
    if (type == "UInt32") return each(std::uint32_t{});
    if (type == "Int64") return each(std::int64_t{});
    fail(array.name.empty() ? "has no array for " + what
                            : text("type ", quote(type), " of ", what, " is not supported"));
  }
  // Calls take(p) for each of the points in an array of coordinates. pre: as of for_each().
  template <class Take>
  void for_each_point(const XmlTag& array, std::uint64_t points, Take take) const {
    if (points == 0) return;
    if (count(array, "NumberOfComponents", 1) != 3) fail("its points have not three coordinates");
    Vec3 p;
    int axis = 0;
    for_each<double>(array, 3 * points, text("the coordinates of ", points, " points"),
                     [&](double x) {
                       p[axis] = x;
                       if (axis == 2) take(p);
                       axis = (axis + 1) % 3;
                     });
  }

 private:
  template <class T, class As, class Take>
  void for_each_of(const XmlTag& array, std::uint64_t count, const std::string& what,
                   Take take) const {
    if constexpr (std::is_integral_v<As> && !std::is_integral_v<T>) {
      fail(what, " are no integers");
    } else if (is_text(array)) {
      const Bytes data = inside(array);
      TextCursor words(data.text());
      for (std::uint64_t n = 0; n < count; ++n) {
        const std::string_view word = words.word();
        if (word.empty()) fail("data is too short: ", what, " need ", count, " numbers");
        const auto value = number_in<T>(word);
        if (!value) fail("there is ", quote(word), " in place of a number");
        take(static_cast<As>(*value));
      }
      if (!words.word().empty()) fail("more than ", count, " numbers for ", what);
    } else {
      const Bytes data = binary(array, count * sizeof(T), what);
      const FieldReader values(data.data, byte_order_);
      for (std::size_t at = 0; at < data.size(); at += sizeof(T)) {
        take(static_cast<As>(values.get<T>(at)));
      }
    }
  }
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
