// SPDX-License-Identifier: MIT
// Files damaged at random, and what holds of all that is read from any bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "base/check.h"
#include "base/random.h"
#include "io/volume/read_volume.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

// Pieces of text that headers, tags and numbers break on; one of them.
inline std::string_view any_piece(Random& random) {
  constexpr std::string_view kPieces =
      "-1~-0~0~1~3~4294967295~4294967297~9223372036854775807~99999999999999999999999~1e308~"
      "1e999~nan~-inf~0x10~\n~\\\n~ ~:~=~#~/~%~(~)~[~<~>~<!--~\"~LIST~LOCAL~none~gzip~ascii~"
      "f 1 2 3\n~property list uchar int vertex_indices\n~element vertex 1\n~"
      "element face 4000000000\n~end_header\n~endsolid\nsolid\n~vertex 1 2 3\n~</Polys><Polys>~"
      "<Piece NumberOfPoints=\"4000000000\">~<mesh>~<object id=\"7\">~</object>~"
      "<item objectid=\"7\"/>~UInt8~offsets~AAAA~\"indices\":0,~{\"mesh\":0}~PK\5\6~"
      "\xff\xff\xff\xff";
  constexpr auto kCount = 1 + std::ranges::count(kPieces, '~');
  std::size_t from = 0;
  for (std::uint32_t n = random.below(kCount); n > 0; --n) from = kPieces.find('~', from) + 1;
  return kPieces.substr(from, kPieces.find('~', from) - from);
}

// One to four edits.
inline std::string damaged(std::string bytes, Random& random) {
  const auto below = [&](std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); };
  // Headers are what hurts: half of the hits go to the first 400 bytes.
  const auto place = [&]() -> std::size_t {
    const std::size_t end = below(2) ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);
    return end == 0 ? 0 : below(end);
  };
  for (std::uint32_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = place(), kind = below(10);
    if (kind == 0) bytes.resize(at);
    if (kind == 1) bytes.insert(at, any_piece(random));
    if (kind == 2) bytes.replace(at, below(8), any_piece(random));
    if (kind == 3) bytes.erase(at, 1 + below(40));
    if (kind == 4) bytes.insert(at, bytes.substr(place(), below(60)));
    if (kind == 5) {  // a number of the text
      const std::size_t from = std::min(bytes.find_first_of("0123456789", at), bytes.size());
      const std::size_t to = std::min(bytes.find_first_not_of("0123456789.", from), bytes.size());
      bytes.replace(from, to - from, any_piece(random));
    }
    if (kind == 6) {
      for (std::size_t n = at; n < std::min(at + 4, bytes.size()); ++n) {
        bytes[n] = below(2) ? '\xff' : '\0';
      }
    }
    if (kind == 7) {  // four or eight bytes become a number, or a large count
      constexpr double kNumbers[] = {NAN, HUGE_VAL, 1e29, -1e30, 1e-300, 1e308, -1, 0, 2e9};
      const double number = kNumbers[below(std::size(kNumbers))];
      std::uint64_t word = std::bit_cast<std::uint64_t>(number);
      if (below(2)) word = std::bit_cast<std::uint32_t>(static_cast<float>(number));
      if (below(3) == 0) word = random.next() >> below(64);
      const std::size_t size = below(2) ? 8 : 4;
      for (std::size_t n = 0; n < size && at + n < bytes.size(); ++n) {
        bytes[at + n] = static_cast<char>(word >> 8 * n);
      }
    }
    if (kind == 8 && !bytes.empty()) bytes[at] = static_cast<char>(random.next());
    if (kind == 9 && !bytes.empty()) bytes[at] ^= static_cast<char>(1 << below(8));
  }
  return bytes;
}

// What is wrong with a message, a mesh or a volume that reading has given; null if nothing is.
inline const char* flaw_of(const InputError& error) {
  const std::string line = error.what();
  if (line.empty()) return "a message without words";
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  return std::ranges::any_of(line, is_control) ? "a control character in a message" : nullptr;
}

inline const char* flaw_of(const TriMesh& mesh) {
  for (const Vec3& p : mesh.points) {
    if (!in_range(p)) return "a point out of range";
  }
  for (const Face& face : mesh.faces) {
    for (const VertexId v : face.v) {
      if (v >= mesh.points.size()) return "a corner that is no vertex";
    }
  }
  return nullptr;
}

// Touches every sample, so that the sanitizers see where they are.
inline const char* flaw_of(const Volume& volume) {
  const Index3 n = volume.dims();
  if (std::min({n.i, n.j, n.k}) < 2) return "a volume without a voxel";
  for (int axis = 0; axis < 3; ++axis) {
    if (!(volume.spacing()[axis] > 0)) return "a spacing that is not positive";
    if (!std::isfinite(volume.frame().origin[axis])) return "an origin that is not finite";
    const Vec3& direction = volume.frame().axes[static_cast<std::size_t>(axis)];
    if (!(std::abs(length(direction) - 1) < 1e-12)) return "an axis that is no unit vector";
  }
  const ValueRange range = value_range(volume, "volume");
  return range.min <= range.max ? nullptr : "an empty range of samples";
}

}  // namespace deliso::test
