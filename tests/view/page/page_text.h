// SPDX-License-Identifier: MIT
// Reading pages back: view/page/page.h, W1.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "io/files/base64.h"
#include "io/files/inflate.h"

namespace deliso {

// What the script element with this id holds; empty where there is none.
inline std::string_view element_of(std::string_view page, std::string_view id) {
  const std::string opening = text("id=\"", id, "\">");
  const std::size_t at = page.find(opening);
  if (at == std::string_view::npos) return {};
  page.remove_prefix(at + opening.size());
  return page.substr(0, page.find("</script>"));
}

// The number behind `key` in the description of an array.
inline std::size_t number_in(std::string_view description, std::string_view key) {
  const std::size_t at = description.find(text("\"", key, "\":"));
  return static_cast<std::size_t>(
      std::stoull(std::string(description.substr(at + key.size() + 3))));
}

// An array of the page; empty where there is none.
template <class T>
std::vector<T> array_of(std::string_view page, std::string_view name) {
  std::string_view description = element_of(page, "arrays");
  const std::size_t at = description.find(text("\"", name, "\":{"));
  if (at == std::string_view::npos) return {};
  description.remove_prefix(at);
  const std::string_view digits = element_of(page, "bytes");
  const std::vector<std::byte> compressed = decode_base64(digits, digits.size());
  std::vector<T> values(number_in(description, "length"));
  const std::size_t offset = number_in(description, "offset");
  std::vector<std::byte> bytes(offset + values.size() * sizeof(T));
  if (inflate(compressed, Wrapping::zlib, bytes).size < bytes.size()) return {};
  if (!values.empty()) std::memcpy(values.data(), bytes.data() + offset, bytes.size() - offset);
  return values;
}

}  // namespace deliso
