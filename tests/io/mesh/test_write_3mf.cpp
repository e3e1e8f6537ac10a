// SPDX-License-Identifier: MIT
// 3MF archives, read by a parser of their own: entries, checksums, sizes, and the mesh as XML.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/files/inflate.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// CRC-32 bit by bit.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t c = 0xffffffff;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) c = c >> 1 ^ (c & 1 ? 0xedb88320 : 0);
  }
  return ~c;
}

std::string inflated(const std::string& data, std::uint32_t sum, std::uint32_t size) {
  std::string gzip("\x1f\x8b\x08\0\0\0\0\0\0\3", 10);
  gzip += data;
  for (const std::uint32_t number : {sum, size}) {
    for (int shift = 0; shift < 32; shift += 8) gzip += static_cast<char>(number >> shift & 0xff);
  }
  std::string out(size, '\0');
  const Inflated result = inflate(std::as_bytes(std::span(gzip)), Wrapping::gzip,
                                  std::as_writable_bytes(std::span(out)));
  CHECK(result.fault == nullptr);
  CHECK(result.ended);
  CHECK(result.size == size);
  return out;
}

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
    parts.emplace_back(name, inflated(bytes.substr(data, packed), sum, size));
    CHECK(checksum(parts.back().second) == sum);
    CHECK(bytes.substr(data + packed, 4) == "PK\7\x8");
    CHECK(bytes.substr(data + packed + 4, 12) == bytes.substr(at + 16, 12));
    next = data + packed + 16;
    at += 46 + name_size;
  }
  CHECK(at == end);
  CHECK(next == four(end + 16));
  return parts;
}

// The numbers in the quotes of all elements of that name.
std::vector<double> numbers(const std::string& xml, const std::string& element) {
  std::vector<double> all;
  for (std::size_t at = xml.find("<" + element + " "); at != std::string::npos;
       at = xml.find("<" + element + " ", at + 1)) {
    const std::string tag = xml.substr(at, xml.find('>', at) - at);
    for (std::size_t q = tag.find('"'); q != std::string::npos;
         q = tag.find('"', tag.find('"', q + 1) + 1)) {
      all.push_back(std::strtod(tag.c_str() + q + 1, nullptr));
    }
  }
  return all;
}

std::string model_of(const TriMesh& mesh) {
  const Parts parts = unzipped(written(mesh, {.format = MeshFormat::three_mf, .comment = "a < b"}));
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].first == "[Content_Types].xml");
  CHECK(parts[1].first == "_rels/.rels");
  CHECK(parts[1].second.find("Target=\"/" + parts[2].first + "\"") != std::string::npos);
  CHECK(parts[2].second.find("<!-- a < b -->\n<model unit=\"millimeter\"") != std::string::npos);
  return parts[2].second;
}

}  // namespace

TEST_CASE("3MF holds the mesh to the last bit") {
  TriMesh mesh = random_sphere(12);
  mesh.frame.origin = {3000, -40000, 1e6};
  const std::string model = model_of(mesh);
  CHECK(model.find("type=\"model\"") != std::string::npos);
  CHECK(model.find("<item objectid=\"1\"/>") != std::string::npos);
  const std::vector<double> x = numbers(model, "vertex"), corners = numbers(model, "triangle");
  REQUIRE(x.size() == 3 * mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    CHECK(Vec3{x[3 * v], x[3 * v + 1], x[3 * v + 2]} ==
          mesh.frame.to_world(mesh.points[VertexId(v)]));
  }
  REQUIRE(corners.size() == 3 * mesh.faces.size());
  for (std::size_t n = 0; n < corners.size(); ++n) {
    CHECK(corners[n] == mesh.faces[FaceId(n / 3)].v[n % 3]);
  }
}

TEST_CASE("3MF: an open mesh is a surface, an empty one no object") {
  TriMesh open = mesh_of({{0, 1, 2}});
  CHECK(model_of(open).find("type=\"surface\"") != std::string::npos);
  const std::string empty = model_of(TriMesh{});
  CHECK(empty.find("<object") == std::string::npos);
  CHECK(empty.find("<item") == std::string::npos);
}

TEST_CASE("3MF larger than a piece of the compressor") {
  const TriMesh mesh = mesh_of(torus_grid(300, 200));
  const std::string model = model_of(mesh);
  CHECK(model.size() > (std::size_t{1} << 22));
  const std::vector<double> corners = numbers(model, "triangle");
  REQUIRE(corners.size() == 3 * mesh.faces.size());
  CHECK(corners.back() == mesh.faces.back().v[2]);
}
