// SPDX-License-Identifier: MIT
// Compressed bytes come back through inflate.h, whose own tests are independent of this compressor.
#include "io/files/deflate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "base/random.h"
#include "io/files/inflated.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Bytes of some alphabet, with copies of earlier parts of every length and distance.
std::string random_content(Random& random, std::size_t size) {
  const std::uint32_t alphabet = 1 + random.below(256), copies = random.below(4);
  std::string out;
  while (out.size() < size) {
    if (out.empty() || random.below(4) >= copies) {
      // The minimum of two makes some bytes frequent and others rare.
      out += static_cast<char>(std::min(random.below(alphabet), random.below(alphabet)));
      continue;
    }
    const std::size_t back = 1 + random.below(static_cast<std::uint32_t>(out.size()));
    for (std::uint32_t n = random.below(400); n > 0; --n) out += out[out.size() - back];
  }
  out.resize(size);
  return out;
}

}  // namespace

TEST_CASE("random contents of all sizes come back") {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::size_t size = seed <= 40 ? seed - 1 : random.below(seed % 10 == 0 ? 300000 : 3000);
    const std::string content = random_content(random, size);
    const std::string data = deflate_zlib(content);
    REQUIRE(inflated(data, Wrapping::zlib, size) == content);
    CHECK(deflate_zlib(content) == data);
  }
}

TEST_CASE("matches at the window's end and beyond come back") {
  Random random(7);
  std::string part;
  for (int n = 0; n < 300; ++n) part += static_cast<char>(random.below(256));
  for (std::size_t gap = 32768 - 310; gap <= 32768 + 10; ++gap) {
    const std::string content = part + std::string(gap - part.size(), 'x') + part;
    REQUIRE(inflated(deflate_zlib(content), Wrapping::zlib, content.size()) == content);
  }
}

TEST_CASE("byte counts like Fibonacci numbers, whose Huffman tree is too deep, come back") {
  std::string content;
  std::size_t a = 1, b = 1;
  for (int symbol = 0; symbol < 22; ++symbol) {
    // Alternation with other bytes keeps the matches short.
    for (std::size_t n = 0; n < a; ++n) content += static_cast<char>(symbol);
    a = std::exchange(b, a + b);
  }
  Random random(3);
  for (std::size_t n = content.size(); n > 1; --n) {
    std::swap(content[n - 1], content[random.below(static_cast<std::uint32_t>(n))]);
  }
  CHECK(inflated(deflate_zlib(content), Wrapping::zlib, content.size()) == content);
}

TEST_CASE("repetitions become small, and random bytes hardly grow") {
  CHECK(deflate_zlib(std::string(1000000, 'a')).size() < 6000);
  std::string noise;
  Random random(1);
  for (int n = 0; n < 100000; ++n) noise += static_cast<char>(random.below(256));
  CHECK(deflate_zlib(noise).size() < 101000);
}

TEST_CASE("pieces given one by one make one stream") {
  Random random(7);
  const std::string content = random_content(random, 9000000);
  DeflateStream stream;
  std::string data;
  std::size_t held = 0;
  for (std::string_view rest = content; !rest.empty();) {
    const std::size_t n = std::min<std::size_t>(rest.size(), random.below(300000));
    const std::string ready = stream.add(rest.substr(0, n));
    rest.remove_prefix(n);
    held = ready.empty() ? held + n : n;
    CHECK(held <= (std::size_t{1} << 22) + 300000);  // no more is kept back
    data += ready;
  }
  data += stream.finish();
  CHECK(inflated(data, Wrapping::zlib, content.size()) == content);
  CHECK(deflate_zlib(content).size() == data.size());
}
