// SPDX-License-Identifier: MIT
// The parts of check_solid.
#pragma once

#include <array>
#include <vector>

#include "check/check_solid.h"
#include "check/triangle_lists.h"

namespace deliso {

// A facet that bounds a region.
struct RegionFacet {
  Triangle v;  // counter-clockwise seen from in front
  RegionId front, behind;
};

// The corners of the facet opposite to each corner of a positive cell, counter-clockwise seen from
// outside of it.
inline constexpr std::array<std::array<int, 3>, 4> kOutward{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

inline Triangle sorted_corners(Triangle t) {
  std::ranges::sort(t);
  return t;
}
// True if one orders the corners as the other does, but for a rotation. pre: the same corners.
inline bool is_same_turn(const Triangle& s, const Triangle& t) {
  return s[0] == t[0] ? s[1] == t[1] : s[0] == t[1] ? s[1] == t[2] : s[1] == t[0];
}

// Returns the facets of one cell, then those between regions, in the order of their sorted corners.
// Reports facets that more than two cells have, or two on one side.
std::vector<RegionFacet> find_region_facets(const Solid& solid, SolidFaults& faults);

// Report faults of the border, whose facets are counter-clockwise seen from outside of the cells;
// of the walls; and of the surface, all against the facets of regions.
void check_border(const std::vector<Vec3>& points, const std::vector<Triangle>& border, int threads,
                  SolidFaults& faults);
void check_walls(const Solid& solid, const std::vector<RegionFacet>& facets, SolidFaults& faults);
SurfaceInSolid compare_surface(const Solid& solid, const std::vector<RegionFacet>& facets,
                               const SolidCheckOptions& options, SolidFaults& faults);

// Return a triangle's words in a fault, and its middle.
std::string name_of_corners(const Triangle& t);
Vec3 middle_of(const std::vector<Vec3>& points, const Triangle& t);

}  // namespace deliso
