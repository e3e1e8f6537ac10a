// SPDX-License-Identifier: MIT
// The surface that a solid is to have as its border and between its regions, triangle by triangle.
//
// A triangle that is no facet was cut, so the facets that lie on it must tile it: their corners are
// on it within a tolerance, and their areas add up to its own. They do not overlap, since facets of
// cells that do not overlap do not.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "check/solid_facets.h"
#include "check/triangle_tree.h"
#include "exact/predicates.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

double twice_area(const std::vector<Vec3>& points, const Triangle& t) {
  return length(area_normal(points[t[0]], points[t[1]], points[t[2]]));
}

// Returns how far p is from the triangle's plane, or in it from the triangle, the larger one.
// Needles leave distance2_to_triangle() no digit; here the height over the plane is exact but for a
// rounding.
double offset_from(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 normal = area_normal(t[0], t[1], t[2]);
  const double area = length(normal);
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  double offset = std::fabs(orient3d_value(t[0], t[1], t[2], p)) / area;
  double longest = 0, beyond = 0;  // the ends of the longest edge
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], edge = t[(i + 1) % 3] - a;
    const double size = length(edge), along = dot(edge, p - a) / size;
    offset = std::max(offset, dot(cross(edge, normal), p - a) / (size * area));
    if (size > longest) longest = size, beyond = std::max(-along, along - size);
  }
  return std::max(offset, beyond);
}

// What is left to compare: triangles that are no facets, and facets that are no triangles.
struct Rest {
  std::vector<FaceId> id;  // of the triangles
  std::vector<Triangle> triangles, facets;
};

// Assigns each facet to the triangle that it lies on, nearest at its corners. Returns twice the
// areas of the facets by triangle.
std::vector<double> assign_facets(const Solid& solid, const std::vector<Vec3>& points,
                                  const Rest& rest, double tolerance, SurfaceInSolid& counts,
                                  SolidFaults& faults) {
  std::vector<double> covered(rest.triangles.size(), 0);
  const TriangleTree tree(points, rest.triangles);
  for (const Triangle& facet : rest.facets) {
    const auto& [a, b, c] = facet;
    const Box3 box = box_of(solid.points[a], solid.points[b], solid.points[c]).grown(tolerance);
    FaceId nearest = kNoId;
    double least = tolerance;
    std::size_t boxes = 0;
    tree.for_each_leaf_at(box, 0, boxes, [&](std::size_t leaf) {
      for (const FaceId f : tree.leaf(leaf)) {
        const Triangle& t = rest.triangles[f];
        double offset = 0;
        for (const VertexId v : facet) {
          offset = std::max(
              offset, offset_from(solid.points[v], {points[t[0]], points[t[1]], points[t[2]]}));
        }
        if (offset <= least) least = offset, nearest = f;
      }
      return true;
    });
    if (nearest == kNoId) {
      faults.add(
          SolidFaultKind::extra_facets,
          [&] { return text("facet ", name_of_corners(facet), " is in no triangle"); },
          middle_of(solid.points, facet));
      continue;
    }
    covered[nearest] += twice_area(solid.points, facet);
    counts.largest_offset = std::max(counts.largest_offset, least);
    ++counts.parts;
  }
  return covered;
}

}  // namespace

SurfaceInSolid compare_surface(const Solid& solid, const std::vector<RegionFacet>& facets,
                               const SolidCheckOptions& options, SolidFaults& faults) {
  const TriMesh& surface = *options.surface;
  SurfaceInSolid counts;
  counts.triangles = surface.faces.size();
  // Points of the surface by the solid's numbers, as far as they are the same.
  std::vector<Vec3> points = solid.points;
  points.insert(points.end(), surface.points.begin(), surface.points.end());
  const std::vector<VertexId> first = first_at_place(points);
  std::vector<Triangle> corners;
  for (const RegionFacet& facet : facets) {
    Triangle t = facet.v;
    for (VertexId& v : t) v = first[v];
    corners.push_back(t);
  }
  const TrianglesByCorners by_corners(points.size(), corners);
  std::vector<std::uint8_t> is_found(facets.size(), 0);
  Rest rest;
  for (FaceId f = 0; f < surface.faces.size(); ++f) {
    Triangle t = surface.faces[f].v;
    for (VertexId& v : t) v = first[solid.points.size() + v];
    const std::uint32_t facet = by_corners.find(sorted_corners(t));
    if (facet != kNoId && !is_found[facet]) {
      is_found[facet] = 1;
      ++counts.whole;
    } else {
      rest.id.push_back(f);
      rest.triangles.push_back(t);
    }
  }
  for (std::size_t n = 0; n < facets.size(); ++n) {
    if (!is_found[n]) rest.facets.push_back(facets[n].v);
  }
  double largest = 0;  // coordinate
  for (const Vec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  const double tolerance = options.cut_tolerance * largest;
  const std::vector<double> covered = assign_facets(solid, points, rest, tolerance, counts, faults);
  for (std::size_t n = 0; n < rest.triangles.size(); ++n) {
    const Triangle& t = rest.triangles[n];
    const double area = twice_area(points, t);
    const double longest = std::sqrt(longest_edge2(points[t[0]], points[t[1]], points[t[2]]));
    if (std::fabs(covered[n] - area) <= 8 * tolerance * longest + 1e-12 * area && covered[n] > 0) {
      ++counts.cut;
      continue;
    }
    faults.add(
        SolidFaultKind::lost_triangles,
        [&] {
          return text("triangle ", rest.id[n], ": facets cover ", covered[n] / area,
                      " of its area");
        },
        middle_of(points, t));
  }
  return counts;
}

}  // namespace deliso
