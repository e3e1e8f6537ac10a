// SPDX-License-Identifier: MIT
// 3MF archives, read by a parser of their own: entries, checksums, sizes.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/files/deflate_writer.h"
#include "io/files/inflated.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Parts = std::vector<std::pair<std::string, std::string>>;

// The parts of a zip archive, by its directory. Each must follow the one before.
Parts unzipped(const std::string& bytes) {
  const auto two = [&](std::size_t at) { return number_at<std::uint16_t>(bytes, at); };
  const auto four = [&](std::size_t at) { return number_at<std::uint32_t>(bytes, at); };
  const std::size_t end = bytes.size() - 22;
  CHECK(bytes.substr(end, 4) == "PK\5\6");
  std::size_t at = four(end + 16), next = 0;
  CHECK(four(end + 12) == end - at);
  Parts parts;
  for (int n = 0; n < two(end + 10); ++n) {
    CHECK(bytes.substr(at, 4) == "PK\1\2");
    const std::uint32_t sum = four(at + 16), packed = four(at + 20), size = four(at + 24);
    const std::size_t name_size = two(at + 28), local = four(at + 42);
    const std::string name = bytes.substr(at + 46, name_size);
    CHECK(local == next);
    CHECK(bytes.substr(local, 4) == "PK\3\4");
    CHECK(bytes.substr(local + 30, name_size) == name);
    CHECK(two(local + 6) == 8);  // flags: sizes and checksum follow the data
    CHECK(two(local + 8) == 8);  // deflated
    CHECK(bytes.substr(local + 4, 10) == bytes.substr(at + 6, 10));
    CHECK(bytes.substr(local + 14, 12) == std::string(12, '\0'));
    const std::size_t data = local + 30 + name_size;
    parts.emplace_back(name, inflated(bytes.substr(data, packed), Wrapping::none, size));
    CHECK(slow_crc32(parts.back().second) == sum);
    CHECK(bytes.substr(data + packed, 4) == "PK\7\x8");
    CHECK(bytes.substr(data + packed + 4, 12) == bytes.substr(at + 16, 12));
    next = data + packed + 16;
    at += 46 + name_size;
  }
  CHECK(at == end);
  CHECK(next == four(end + 16));
  return parts;
}

std::string written_3mf(const TriMesh& mesh) {
  return written(mesh, {.format = MeshFormat::three_mf, .comment = "a < b"});
}

std::string model_in(const std::string& bytes) {
  const Parts parts = unzipped(bytes);
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].first == "[Content_Types].xml");
  CHECK(parts[1].first == "_rels/.rels");
  CHECK(parts[1].second.find("Target=\"/" + parts[2].first + "\"") != std::string::npos);
  CHECK(parts[2].second.find("<!-- a < b -->\n<model unit=\"millimeter\"") != std::string::npos);
  return parts[2].second;
}

}  // namespace

// test_read_mesh.cpp has the vertices and facets.
TEST_CASE("3MF: a closed mesh is a model, an open one a surface, an empty one no object") {
  const std::string closed = model_in(written_3mf(random_sphere(12)));
  CHECK(closed.find("type=\"model\"") != std::string::npos);
  CHECK(closed.find("<item objectid=\"1\"/>") != std::string::npos);
  const std::string open = model_in(written_3mf(mesh_of({{0, 1, 2}})));
  CHECK(open.find("type=\"surface\"") != std::string::npos);
  const std::string empty = model_in(written_3mf(TriMesh{}));
  CHECK(empty.find("<object") == std::string::npos);
  CHECK(empty.find("<item") == std::string::npos);
}

TEST_CASE("3MF larger than a piece of the compressor") {
  const TriMesh mesh = mesh_of(torus_grid(300, 200));
  const std::string bytes = written_3mf(mesh);
  CHECK(model_in(bytes).size() > (std::size_t{1} << 22));
  CHECK(same_mesh(parse_mesh(bytes, MeshFormat::three_mf, "in"), mesh));
}
