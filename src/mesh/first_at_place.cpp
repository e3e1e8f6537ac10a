// SPDX-License-Identifier: MIT
#include "mesh/first_at_place.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace deliso {

std::vector<VertexId> first_at_place(std::span<const Vec3> points) {
  struct Place {
    std::array<std::uint64_t, 3> bits;
    VertexId point;
  };
  // Equal positions are adjacent, the first point in front.
  std::vector<Place> places(points.size());
  for (VertexId v = 0; v < points.size(); ++v) {
    const auto bits = [&](int axis) { return std::bit_cast<std::uint64_t>(points[v][axis] + 0.0); };
    places[v] = {{bits(0), bits(1), bits(2)}, v};
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.bits != b.bits ? a.bits < b.bits : a.point < b.point;
  });
  std::vector<VertexId> first(points.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const bool again = n > 0 && places[n].bits == places[n - 1].bits;
    first[places[n].point] = again ? first[places[n - 1].point] : places[n].point;
  }
  return first;
}

}  // namespace deliso
