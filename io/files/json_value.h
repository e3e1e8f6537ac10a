// SPDX-License-Identifier: MIT
// A reader of JSON (RFC 8259). Memory is bounded by the size of the text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

struct JsonValue {
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  double number = 0;                // of a boolean 0 or 1
  std::string string{};             // escapes of characters beyond ASCII are `?`
  std::vector<std::string> keys{};  // of an object's members, in the order of `items`
  std::vector<JsonValue> items{};

  // Returns the member; a null value if there is none, or this is no object.
  const JsonValue& operator[](std::string_view key) const;
  bool is_null() const { return kind == Kind::null; }
};

// Throws InputError, with the `name` and the byte, if the text is no JSON or nests too deeply.
JsonValue parse_json(std::string_view text, std::string_view name);

}  // namespace deliso
