// SPDX-License-Identifier: MIT
#include "io/files/json_value.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

#include "base/text.h"
#include "io/files/input_file.h"

namespace deliso {
namespace {

class JsonParser {
 public:
  JsonParser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  JsonValue run() {
    JsonValue value = parse_value(0);
    if (!skip_space().empty()) fail("there is more behind its end");
    return value;
  }

 private:
  static constexpr int kMostDepth = 100;  // glTF needs 7

  [[noreturn]] void fail(const char* fault) const {
    deliso::fail(name_, "its JSON is damaged at byte ", at_, ": ", fault);
  }
  // Returns what is left.
  std::string_view skip_space() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    return text_.substr(at_);
  }
  bool take(std::string_view word) {
    if (!skip_space().starts_with(word)) return false;
    at_ += word.size();
    return true;
  }

  JsonValue parse_value(int depth) {
    if (depth > kMostDepth) fail("it nests too deeply");
    JsonValue value;
    if (take("null")) return value;
    if (take("{")) {
      value.kind = JsonValue::Kind::object;
      parse_items("}", value, [&] {
        value.keys.push_back(parse_string());
        if (!take(":")) fail("there is no ':'");
        value.items.push_back(parse_value(depth + 1));
      });
    } else if (take("[")) {
      value.kind = JsonValue::Kind::array;
      parse_items("]", value, [&] { value.items.push_back(parse_value(depth + 1)); });
    } else if (skip_space().starts_with('"')) {
      value.kind = JsonValue::Kind::string;
      value.string = parse_string();
    } else if (const bool is_true = take("true"); is_true || take("false")) {
      value.kind = JsonValue::Kind::boolean;
      value.number = is_true ? 1 : 0;
    } else {
      value.kind = JsonValue::Kind::number;
      value.number = parse_number();
    }
    return value;
  }

  template <class ParseItem>
  void parse_items(std::string_view end, const JsonValue& list, ParseItem parse_item) {
    while (!take(end)) {
      if (!list.items.empty() && !take(",")) fail("there is no ','");
      parse_item();
    }
  }

  double parse_number() {
    const std::string_view rest = skip_space();
    const std::size_t digit = rest.starts_with('-') ? 1 : 0;
    double number = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    // from_chars takes `inf` and `nan` too.
    if (digit >= rest.size() || rest[digit] < '0' || rest[digit] > '9' || error != std::errc{})
      fail("there is no value");
    at_ += static_cast<std::size_t>(stop - rest.data());
    return number;
  }

  std::string parse_string() {
    if (!take("\"")) fail("there is no string");
    std::string result;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        ++at_;
        return result;
      }
      if (c == '\\') {
        constexpr std::string_view kLetters = "nrtbf", kMeanings = "\n\r\t\b\f";
        if (++at_ == text_.size()) break;
        if (text_[at_] == 'u') {
          append_utf8(parse_code_point(), result);
          continue;
        }
        const std::size_t letter = kLetters.find(text_[at_]);
        result += letter == std::string_view::npos ? text_[at_] : kMeanings[letter];
      } else {
        result += c;
      }
    }
    fail("a string does not end");
  }

  // Returns the number in the four digits behind the byte at_, which moves to the last of them.
  std::uint32_t parse_hexadecimal() {
    const std::string_view digits = text_.substr(at_ + 1, 4);
    std::uint32_t number = 0;
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    if (digits.size() < 4 || error != std::errc{} || stop != digits.data() + 4) {
      fail("\\u has no four digits");
    }
    at_ += 4;
    return number;
  }

  // Returns the character of \uXXXX, or of two of these that are a pair of surrogates (RFC 8259,
  // 7). One without the other is no character: U+FFFD.
  std::uint32_t parse_code_point() {
    constexpr std::uint32_t kReplacement = 0xfffd;
    const std::uint32_t first = parse_hexadecimal();
    if (first < 0xd800 || first > 0xdfff) return first;
    if (first > 0xdbff || text_.substr(at_ + 1, 2) != "\\u") return kReplacement;
    const std::size_t before = at_;
    at_ += 2;
    const std::uint32_t second = parse_hexadecimal();
    if (second >= 0xdc00 && second <= 0xdfff) {
      return 0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00);
    }
    at_ = before;
    return kReplacement;
  }

  static void append_utf8(std::uint32_t c, std::string& to) {
    const auto append = [&](std::uint32_t byte) { to += static_cast<char>(byte); };
    const auto append_rest = [&](unsigned shift) { append(0x80 | (c >> shift & 0x3f)); };
    if (c < 0x80) {
      append(c);
    } else if (c < 0x800) {
      append(0xc0 | c >> 6);
      append_rest(0);
    } else if (c < 0x10000) {
      append(0xe0 | c >> 12);
      append_rest(6);
      append_rest(0);
    } else {
      append(0xf0 | c >> 18);
      append_rest(12);
      append_rest(6);
      append_rest(0);
    }
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
};

}  // namespace

const JsonValue& JsonValue::operator[](std::string_view key) const {
  static const JsonValue none;
  const auto at = std::find(keys.begin(), keys.end(), key);
  return at == keys.end() ? none : items[static_cast<std::size_t>(at - keys.begin())];
}

JsonValue parse_json(std::string_view text, std::string_view name) {
  return JsonParser(text, name).run();
}

}  // namespace deliso
