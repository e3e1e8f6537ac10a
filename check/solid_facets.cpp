// SPDX-License-Identifier: MIT
#include "check/solid_facets.h"

#include <algorithm>

#include "base/text.h"

namespace deliso {

std::vector<RegionFacet> find_region_facets(const Solid& solid, SolidFaults& faults) {
  std::vector<Triangle> all;  // of cell c: 4 c to 4 c + 3
  all.reserve(4 * solid.cells.size());
  for (const Tetrahedron& v : solid.cells) {
    for (const auto& [a, b, c] : kOutward) all.push_back({v[a], v[b], v[c]});
  }
  const TrianglesByCorners by_corners(solid.points.size(), all);
  const auto entries = by_corners.all();
  std::vector<RegionFacet> border, between;
  for (std::size_t n = 0, end; n < entries.size(); n = end) {
    for (end = n + 1; end < entries.size() && entries[end].corners == entries[n].corners;) ++end;
    const std::uint32_t first = entries[n].triangle;
    const Triangle& v = all[first];
    const auto report = [&](SolidFaultKind kind, const char* words) {
      faults.add(
          kind,
          [&] {
            std::string cells;
            for (std::size_t k = n; k < end; ++k) cells += text(" ", entries[k].triangle / 4);
            return text("facet ", name_of_corners(v), words, cells);
          },
          middle_of(solid.points, v));
    };
    if (end - n > 2) {
      report(SolidFaultKind::crowded_facets, " is of the cells");
      continue;
    }
    const RegionId behind = solid.regions[first / 4];
    if (end - n == 1) {
      border.push_back({v, kOutside, behind});
      continue;
    }
    const std::uint32_t second = entries[n + 1].triangle;
    if (is_same_turn(v, all[second])) {
      report(SolidFaultKind::one_sided_facets, " has on one side the cells");
    }
    const RegionId front = solid.regions[second / 4];
    if (front != behind) between.push_back({v, front, behind});
  }
  border.insert(border.end(), between.begin(), between.end());
  return border;
}

void check_walls(const Solid& solid, const std::vector<RegionFacet>& facets, SolidFaults& faults) {
  std::vector<Triangle> corners, walls;
  for (const RegionFacet& facet : facets) corners.push_back(facet.v);
  for (const Wall& wall : solid.walls) walls.push_back(wall.v);
  const TrianglesByCorners by_corners(solid.points.size(), corners);
  std::vector<std::uint8_t> is_wall(facets.size(), 0);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wall& wall = solid.walls[w];
    const std::uint32_t f = by_corners.find(sorted_corners(wall.v));
    const auto report = [&](SolidFaultKind kind) {
      faults.add(
          kind, [&] { return text("wall ", w, " ", name_of_corners(wall.v)); },
          middle_of(solid.points, wall.v));
    };
    if (f == kNoId || is_wall[f]) {
      report(SolidFaultKind::extra_walls);
      continue;
    }
    is_wall[f] = 1;
    if (wall.front == kOutside && wall.behind == kOutside) continue;
    const RegionFacet& facet = facets[f];
    const bool is_turned = !is_same_turn(facet.v, wall.v);
    if (wall.front != (is_turned ? facet.behind : facet.front) ||
        wall.behind != (is_turned ? facet.front : facet.behind)) {
      report(SolidFaultKind::turned_walls);
    }
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (is_wall[f]) continue;
    faults.add(
        SolidFaultKind::missing_walls,
        [&] {
          return text("facet ", name_of_corners(facets[f].v), " between the regions ",
                      facets[f].front, " and ", facets[f].behind);
        },
        middle_of(solid.points, facets[f].v));
  }
}

}  // namespace deliso
