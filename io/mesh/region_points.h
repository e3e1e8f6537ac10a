// SPDX-License-Identifier: MIT
// Points inside the regions that facets bound, so that a program that fills a mesh names what is in
// each.
//
// The facets that border on a label are its surface, and each connected component of this is the
// outer boundary of a region of the label, or that of a cavity in it. With normals out of the
// label, the first encloses a positive volume and the second a negative one. So every bounded
// region has one outer boundary, hence one point; the background outside of everything has none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

struct RegionPoint {
  Vec3 p;
  std::int64_t label = 0;
};

struct RegionPoints {
  std::vector<RegionPoint> points;  // in the order of the labels
  // Labels of which a component is open, ascending: it bounds no region, and has no point.
  std::vector<std::int64_t> open;
};

// Triangles with a label in front of each and one behind. Of those from `first_cap` on, which close
// labels on the box, only the one behind counts.
struct LabeledTriangles {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;  // counter-clockwise seen from the label in front
  std::span<const std::array<std::int64_t, 2>> sides;
  std::size_t first_cap = 0;

  // True if the facet borders on a label in front (0) or behind (1).
  bool has_label(std::size_t facet, std::size_t side) const {
    return side == 1 || facet < first_cap;
  }
};

// Returns a point of each bounded region: half the way from a large facet of its outer boundary to
// the next facet. Cost: n log n for n facets. pre: no facets cross.
RegionPoints region_points(const LabeledTriangles& mesh);

}  // namespace deliso
