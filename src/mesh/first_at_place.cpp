// SPDX-License-Identifier: MIT
#include "mesh/first_at_place.h"

#include <array>
#include <bit>
#include <cstdint>

namespace deliso {
namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const Vec3& p) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  return {bits(p.x), bits(p.y), bits(p.z)};
}

std::uint64_t hash(const Bits& bits) {
  std::uint64_t h = 0;
  for (const std::uint64_t word : bits) {
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;  // the digits of round numbers are in the high half alone
  }
  return h;
}

}  // namespace

std::vector<VertexId> first_at_place(std::span<const Vec3> points) {
  // A hash of first points, with free places between them.
  std::vector<VertexId> table(std::bit_ceil(2 * points.size() + 1), kNoId), first;
  const std::size_t mask = table.size() - 1;
  first.reserve(points.size());
  for (VertexId v = 0; v < points.size(); ++v) {
    const Bits bits = bits_of(points[v]);
    std::size_t place = hash(bits) & mask;
    while (table[place] != kNoId && bits_of(points[table[place]]) != bits) {
      place = (place + 1) & mask;
    }
    if (table[place] == kNoId) table[place] = v;
    first.push_back(table[place]);
  }
  return first;
}

}  // namespace deliso
