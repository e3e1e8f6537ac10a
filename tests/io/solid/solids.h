// SPDX-License-Identifier: MIT
// Small solids to write, by hand and at random.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "exact/predicates.h"
#include "io/files/temporary_folder.h"
#include "io/solid/write_solid.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

// Sets the walls: the facets of one cell, and those between regions.
inline void set_walls(Solid& solid) {
  struct Sides {
    Triangle v;  // counter-clockwise seen from outside of the first cell
    RegionId behind, front;
  };
  std::map<std::array<std::uint32_t, 3>, Sides> facets;
  for (std::size_t c = 0; c < solid.cells.size(); ++c) {
    const auto& [p, q, r, s] = solid.cells[c];
    for (const Triangle& t : {Triangle{q, r, s}, {p, s, r}, {p, q, s}, {p, r, q}}) {
      std::array<std::uint32_t, 3> key{t[0], t[1], t[2]};
      std::ranges::sort(key);
      const auto [entry, is_new] = facets.try_emplace(key, Sides{t, solid.regions[c], kOutside});
      if (!is_new) entry->second.front = solid.regions[c];
    }
  }
  for (const auto& [key, facet] : facets) {
    if (facet.front != facet.behind) solid.walls.push_back({facet.v, facet.front, facet.behind});
  }
}

// The cube of six tetrahedra around its diagonal, at random a bit out of shape, in regions 1 to
// `regions`.
inline Solid cube(RegionId regions, std::uint64_t seed = 1) {
  Random random(seed);
  Solid solid;
  for (std::uint32_t n = 0; n < 8; ++n) {
    const auto near = [&](std::uint32_t bit) { return bit + random.uniform(-.1, .1); };
    solid.points.push_back({near(n & 1), near(n >> 1 & 1), near(n >> 2)});
  }
  std::array<std::uint32_t, 3> order{0, 1, 2};
  do {
    const std::uint32_t one = 1u << order[0], two = one | 1u << order[1];
    Tetrahedron cell{VertexId(0), VertexId(one), VertexId(two), VertexId(7)};
    const auto& p = solid.points;
    if (orient3d(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]) < 0) std::swap(cell[0], cell[1]);
    solid.regions.push_back(static_cast<RegionId>(1 + solid.cells.size() % regions));
    solid.cells.push_back(cell);
  } while (std::next_permutation(order.begin(), order.end()));
  solid.skin_points = 8;
  set_walls(solid);
  return solid;
}

inline Frame turned_frame(bool mirrored) {
  Frame frame{{100, -20, 3.25}, {Vec3{0, 1, 0}, Vec3{-.6, 0, .8}, Vec3{.8, 0, .6}}};
  if (mirrored) frame.axes[2] = -frame.axes[2];
  frame.space = AnatomicalSpace::ras;
  return frame;
}

inline std::string written(const Solid& solid, const Frame& frame, SolidWriteOptions options) {
  const TemporaryFolder folder;
  write_solid(solid, frame, folder / "solid", options);
  return file_bytes(folder / "solid");
}

}  // namespace deliso::test
