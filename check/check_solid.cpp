// SPDX-License-Identifier: MIT
#include "check/check_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "base/triangle.h"
#include "check/solid_facets.h"
#include "exact/predicates.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

// Checks points and cells, each alone. Returns whether points are finite.
bool check_points(const Solid& solid, SolidFaults& faults) {
  IdArray<VertexId, std::uint8_t> is_used(solid.points.size(), 0);
  for (const Tetrahedron& cell : solid.cells) {
    for (const VertexId v : cell) is_used[v] = 1;
  }
  const std::vector<VertexId> first = first_at_place(solid.points);
  for (VertexId v = 0; v < solid.points.size(); ++v) {
    const Vec3& p = solid.points[v];
    if (!is_finite(p)) {
      faults.add(
          SolidFaultKind::points_not_finite, [&] { return text("point ", v); }, p);
    }
    if (!is_used[v]) {
      faults.add(
          SolidFaultKind::unused_points, [&] { return text("point ", v); }, p);
    }
    if (first[v] != v) {
      faults.add(
          SolidFaultKind::duplicate_points,
          [&] { return text("point ", v, " is where point ", first[v], " is"); }, p);
    }
  }
  return faults.count(SolidFaultKind::points_not_finite) == 0;
}

// Appends the six dihedral angles of a cell, in degrees.
void add_angles(const std::array<Vec3, 4>& p, double sixfold_volume, std::vector<float>& angles) {
  std::array<Vec3, 4> normal;  // twice as long as the facet's area
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [a, b, c] = kOutward[i];
    normal[i] = area_normal(p[a], p[b], p[c]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      // The edge between both facets has the two other corners.
      std::array<std::size_t, 2> ends{};
      for (std::size_t n = 0, found = 0; n < 4; ++n) {
        if (n != i && n != k) ends[found++] = n;
      }
      // |n x n'| is six times the volume times the length of the edge.
      const double sine = sixfold_volume * distance(p[ends[0]], p[ends[1]]);
      angles.push_back(static_cast<float>(std::atan2(sine, -dot(normal[i], normal[k])) *
                                          (180 / std::numbers::pi)));
    }
  }
}

DihedralAngles summary_of(std::vector<float>& angles) {
  if (angles.empty()) return {};
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(angles.size()));
    const auto place = angles.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(angles, place);
    return double{*place};
  };
  return {*std::ranges::min_element(angles), at(.01), at(.05), *std::ranges::max_element(angles)};
}

void measure_cells(const Solid& solid, SolidCheck& check) {
  std::vector<float> angles;
  angles.reserve(6 * solid.cells.size());
  for (std::size_t c = 0; c < solid.cells.size(); ++c) {
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = solid.points[solid.cells[c][i]];
    if (orient3d(p[0], p[1], p[2], p[3]) <= 0) {
      check.faults.add(
          SolidFaultKind::cells_not_positive,
          [&] {
            return text("cell ", c, " (", joined(solid.cells[c], " "), ") has ",
                        orient3d(p[0], p[1], p[2], p[3]) == 0 ? "no volume" : "a negative volume");
          },
          0.25 * (p[0] + p[1] + p[2] + p[3]));
    }
    const double sixfold = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    const RegionId r = solid.regions[c];
    if (r >= check.regions.size()) check.regions.resize(std::size_t{r} + 1);
    ++check.regions[r].cells;
    check.regions[r].volume += sixfold / 6;
    check.volume += sixfold / 6;
    add_angles(p, sixfold, angles);
  }
  check.angles = summary_of(angles);
}

}  // namespace

SolidCheck check_solid(const Solid& solid, const SolidCheckOptions& options) {
  SolidCheck check;
  check.points = solid.points.size();
  check.cells = solid.cells.size();
  check.walls = solid.walls.size();
  if (!check_points(solid, check.faults)) return check;
  measure_cells(solid, check);
  const std::vector<RegionFacet> facets = find_region_facets(solid, check.faults);
  std::vector<Triangle> border;
  for (const RegionFacet& facet : facets) {
    if (facet.front == kOutside) border.push_back(facet.v);
  }
  check.border_facets = border.size();
  check.region_facets = facets.size() - border.size();
  if (check.faults.count(SolidFaultKind::duplicate_points) == 0) {
    check_border(solid.points, border, options.threads, check.faults);
  }
  if (!solid.walls.empty()) check_walls(solid, facets, check.faults);
  if (options.surface) check.surface = compare_surface(solid, facets, options, check.faults);
  return check;
}

std::string name_of_corners(const Triangle& t) {
  return text("(", t[0], " ", t[1], " ", t[2], ")");
}

Vec3 middle_of(const std::vector<Vec3>& points, const Triangle& t) {
  return (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
}

}  // namespace deliso
