// SPDX-License-Identifier: MIT
#include "view/page/page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/text.h"
#include "io/files/input_file.h"
#include "io/files/temporary_folder.h"
#include "view/page/page_text.h"
#include "view/page/web_sources.h"

using namespace deliso;

namespace {

std::string page_of(std::string_view title, std::string_view header, const PageData& data) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "page.html";
  write_page(path, title, header, data);
  return std::string(open_file(path).text());
}

}  // namespace

TEST_CASE("arrays of every type come back, each begun at a multiple of four") {
  const std::vector<float> floats = {0, -1.5f, 1e-30f, std::numeric_limits<float>::infinity(),
                                     std::nanf("")};
  const std::vector<std::uint32_t> words = {0, 1, 0xffffffff};
  const std::vector<std::uint16_t> halves = {1, 65535, 3};
  PageData data;
  std::vector<std::uint8_t> octets(100'001);
  for (std::size_t n = 0; n < octets.size(); ++n) octets[n] = static_cast<std::uint8_t>(n * n >> 3);
  data.add("floats", floats);
  data.add("none", std::vector<float>{});
  data.add("halves", halves);
  data.add("octets", octets);
  data.add("words", words);
  const std::string page = page_of("t", "{}", data);

  const std::vector<float> read = array_of<float>(page, "floats");
  REQUIRE(read.size() == floats.size());
  for (std::size_t n = 0; n + 1 < floats.size(); ++n) CHECK(read[n] == floats[n]);
  CHECK(std::isnan(read.back()));
  CHECK(array_of<std::uint32_t>(page, "words") == words);
  CHECK(array_of<std::uint16_t>(page, "halves") == halves);
  CHECK(array_of<std::uint8_t>(page, "octets") == octets);
  CHECK(element_of(page, "arrays").find("\"none\":{\"type\":\"f32\",\"offset\":20,\"length\":0}") !=
        std::string_view::npos);
  const std::string directory = data.directory();
  constexpr std::string_view kOffset = "\"offset\":";
  std::size_t count = 0;
  for (std::size_t at = directory.find(kOffset); at != std::string::npos;
       at = directory.find(kOffset, at + 1), ++count) {
    CHECK(std::stoul(directory.substr(at + kOffset.size())) % 4 == 0);
  }
  CHECK(count == 5);
}

TEST_CASE("names that would end a script or open a tag are text") {
  const std::string evil = "</script><script>alert(1)</script><!--.ply";
  const std::string page =
      page_of(evil + " & more", text(R"({"name": ")", evil, "\"}"), PageData());
  CHECK(page.find("alert(1)</script>") == std::string::npos);
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find(
            "<title>&lt;/script>&lt;script>alert(1)&lt;/script>&lt;!--.ply &amp; more</title>") !=
        std::string::npos);
  CHECK(element_of(page, "header") ==
        "{\"name\": \"\\u003c/script>\\u003cscript>alert(1)\\u003c/script>\\u003c!--.ply\"}");
}

TEST_CASE("a page holds all sources, and asks nothing of others") {
  const std::string page = page_of("t", "{}", PageData());
  std::size_t sources = 0;
  for (const WebSource& source : web_sources()) {
    if (source.name == "page.html") continue;
    ++sources;
    std::string content;
    for (const std::string_view piece : source.pieces) {
      CHECK(piece.size() <= 15'000);
      CHECK(piece.ends_with('\n'));
      content += piece;
    }
    INFO(source.name);
    CHECK(page.find(content) != std::string::npos);
    CHECK(content.find("</script") == std::string::npos);
  }
  CHECK(sources >= 2);
  for (const char* outside : {"http://", "https://", "src=", "<link", "@import", "url(", "import(",
                              "fetch(", "XMLHttpRequest", "WebSocket", "sendBeacon"}) {
    INFO(outside);
    CHECK(page.find(outside) == std::string::npos);
  }
}

TEST_CASE("the same data give the same bytes") {
  PageData data;
  data.add("a", std::vector<float>{1, 2, 3});
  CHECK(page_of("t", "{}", data) == page_of("t", "{}", data));
}
