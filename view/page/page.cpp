// SPDX-License-Identifier: MIT
#include "view/page/page.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <optional>

#include "base/check.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/base64.h"
#include "io/files/deflate.h"
#include "view/page/web_sources.h"

namespace deliso {
namespace {

// W2.
std::string without_tags(std::string_view s, std::string_view for_less) {
  std::string out;
  out.reserve(s.size());
  for (const char c : s) {
    if (c == '<') {
      out += for_less;
    } else {
      out += c;
    }
  }
  return out;
}

std::string in_markup(std::string_view s) {
  std::string out;
  for (const char c : s) {
    if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return without_tags(out, "&lt;");
}

const WebSource& source_named(std::string_view name, const PageSources& sources) {
  const auto own = std::ranges::find(sources.own, name, &WebSource::name);
  if (own != sources.own.end()) return *own;
  const std::span<const WebSource> all = web_sources();
  const auto found = std::ranges::find(all, name, &WebSource::name);
  DELISO_CHECK(found != all.end());
  return *found;
}

// What stands between `before` and `after` in a line that is nothing else; blanks in front apart.
std::optional<std::string_view> between(std::string_view line, std::string_view before,
                                        std::string_view after) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  if (!line.starts_with(before) || !line.ends_with(after)) return std::nullopt;
  return line.substr(before.size(), line.size() - before.size() - after.size());
}

void write_element(AtomicFile& out, std::string_view tag, const WebSource& content) {
  out.write(text("<", tag, ">\n"));
  for (const std::string_view piece : content.pieces) out.write(piece);
  out.write(text("</", tag, ">\n"));
}

void write_data(AtomicFile& out, std::string_view header, const PageData& data) {
  constexpr std::string_view kJson = R"(<script type="application/json" id=")";
  constexpr std::string_view kEnd = "</script>\n";
  out.write(text(kJson, "header\">", without_tags(header, "\\u003c"), kEnd));
  out.write(text(kJson, "arrays\">", without_tags(data.directory(), "\\u003c"), kEnd));
  out.write(R"(<script type="text/plain" id="bytes">)");
  DeflateStream stream;
  std::string waiting;  // less than a group of three, so that no padding is within
  const auto encode = [&](std::string_view compressed, bool last) {
    waiting += compressed;
    const std::size_t ready = last ? waiting.size() : waiting.size() / 3 * 3;
    out.write(encode_base64(std::as_bytes(std::span(waiting).first(ready))));
    waiting.erase(0, ready);
  };
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  for (std::string_view rest = data.bytes(); !rest.empty();) {
    encode(stream.add(rest.substr(0, kPiece)), false);
    rest.remove_prefix(std::min(kPiece, rest.size()));
  }
  encode(stream.finish(), true);
  out.write(kEnd);
}

}  // namespace

template <class T>
void PageData::put(std::string_view name, std::string_view type, std::span<const T> values) {
  static_assert(std::endian::native == std::endian::little, "the page's bytes are little-endian");
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  if (!directory_.empty()) directory_ += ",\n";
  directory_ += text("\"", name, R"(":{"type":")", type, R"(","offset":)", bytes_.size(),
                     R"(,"length":)", values.size(), "}");
  bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void PageData::add(std::string_view name, std::span<const float> values) {
  put(name, "f32", values);
}
void PageData::add(std::string_view name, std::span<const std::uint32_t> values) {
  put(name, "u32", values);
}
void PageData::add(std::string_view name, std::span<const std::uint16_t> values) {
  put(name, "u16", values);
}
void PageData::add(std::string_view name, std::span<const std::uint8_t> values) {
  put(name, "u8", values);
}

// Writes the markup. A line that links a style sheet or a script is replaced by that file, and the
// line of the data by the data.
void write_page(const std::string& path, std::string_view title, std::string_view header,
                const PageData& data, const PageSources& sources) {
  AtomicFile out(path);
  for (std::string_view rest : source_named(sources.markup, sources).pieces) {
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(line.size() + 1);
      if (const auto style = between(line, R"(<link rel="stylesheet" href=")", "\">")) {
        write_element(out, "style", source_named(*style, sources));
      } else if (const auto script = between(line, "<script src=\"", R"("></script>)")) {
        write_element(out, "script", source_named(*script, sources));
      } else if (between(line, "<title>", "</title>")) {
        out.write(text("<title>", in_markup(title), "</title>\n"));
      } else if (between(line, "<!-- data", " -->")) {
        write_data(out, header, data);
      } else {
        out.write(text(line, "\n"));
      }
    }
  }
  out.commit();
}

}  // namespace deliso
