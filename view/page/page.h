// SPDX-License-Identifier: MIT
// Writes pages for a browser. A page is one HTML file with its markup, style and scripts
// (view/page/web, built in) and its data. It needs no network.
//
//   W1  The data is a header, JSON in <script id="header">, and named flat arrays of numbers. A
//       table of the arrays is JSON in <script id="arrays">:
//         {"points": {"type": "f32", "offset": 0, "length": 3}, ...}
//       Offsets are in bytes, multiples of 4. Lengths are in elements. The bytes of all arrays,
//       little-endian, compressed (zlib) and in base64, are in <script id="bytes">.
//   W2  No text in a page can end its element: "<" is \u003c in JSON and &lt; in markup.
//   W3  The same sources, title, header and data give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "view/page/web_sources.h"

namespace deliso {

// Arrays are kept as a page holds them, one behind the other. Names are identifiers and differ.
class PageData {
 public:
  void add(std::string_view name, std::span<const float> values);
  void add(std::string_view name, std::span<const std::uint32_t> values);
  void add(std::string_view name, std::span<const std::uint16_t> values);
  void add(std::string_view name, std::span<const std::uint8_t> values);

  std::string_view bytes() const { return bytes_; }
  std::string directory() const { return "{" + directory_ + "}"; }  // JSON, W1

 private:
  template <class T>
  void put(std::string_view name, std::string_view type, std::span<const T> values);

  std::string bytes_, directory_;
};

// Which page: the name of its markup, and its own sources. Those of view/page/web belong to every
// page.
struct PageSources {
  std::string_view markup = "page.html";
  std::span<const WebSource> own{};
};

// Writes the page, whole or not at all; `-` is standard output. `header` is the text of a JSON
// object, whose "kind" says to the scripts what the page shows. Throws InputError.
void write_page(const std::string& path, std::string_view title, std::string_view header,
                const PageData& data, const PageSources& sources = {});

}  // namespace deliso
