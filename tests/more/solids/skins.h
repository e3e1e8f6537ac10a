// SPDX-License-Identifier: MIT
// Skins with a known inside, and what holds of every solid made of one.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"
#include "base/vec3.h"
#include "check/check_solid.h"
#include "mesh/tri_mesh.h"
#include "more/solids/make_solid.h"

namespace deliso::test {

// The skin of a closed mesh: region 1 is behind its facets.
inline Skin skin_of(const TriMesh& mesh) {
  Skin skin{mesh.points, {}};
  for (const Face& face : mesh.faces) skin.walls.push_back({face.v, kOutside, 1});
  return skin;
}

inline Skin skin_of(std::vector<Vec3> points, const std::vector<Triangle>& triangles) {
  Skin skin{std::move(points), {}};
  for (const Triangle& t : triangles) skin.walls.push_back({t, kOutside, 1});
  return skin;
}

// Appends all of another skin. Points at one place become one.
inline void append(Skin& skin, const Skin& other) {
  for (Wall wall : other.walls) {
    for (VertexId& v : wall.v) {
      const Vec3& p = other.points[v];
      const auto at = std::ranges::find(skin.points, p);
      v = VertexId(at - skin.points.begin());
      if (at == skin.points.end()) skin.points.push_back(p);
    }
    skin.walls.push_back(wall);
  }
}

// The borders of unit cubes, each in the region that `region` says, in a box of n cubes a side.
// Their faces are squares of two walls each: coplanar, cospherical, and with diagonals at random.
inline Skin cubes_skin(int n, const std::function<RegionId(int, int, int)>& region,
                       Random& random) {
  Skin skin;
  std::map<std::array<int, 3>, VertexId> numbers;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [entry, is_new] = numbers.try_emplace(at, VertexId(skin.points.size()));
    if (is_new) skin.points.push_back({1. * at[0], 1. * at[1], 1. * at[2]});
    return entry->second;
  };
  const auto region_at = [&](std::array<int, 3> at) {
    const bool is_in = std::ranges::all_of(at, [n](int x) { return x >= 0 && x < n; });
    return is_in ? region(at[0], at[1], at[2]) : kOutside;
  };
  for (int k = -1; k < n; ++k) {
    for (int j = -1; j < n; ++j) {
      for (int i = -1; i < n; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> low{i, j, k}, high = low;
          ++high[axis];
          const RegionId behind = region_at(low), front = region_at(high);
          if (behind == front) continue;
          // The square between them, counter-clockwise seen along the axis from above.
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          std::array<VertexId, 4> corner{};
          for (std::size_t c = 0; c < 4; ++c) {
            std::array<int, 3> at = high;
            at[u] += c == 1 || c == 2;
            at[v] += c >= 2;
            corner[c] = vertex(at);
          }
          const std::size_t s = random.below(2);
          skin.walls.push_back({{corner[s], corner[s + 1], corner[s + 2]}, front, behind});
          skin.walls.push_back({{corner[s], corner[s + 2], corner[(s + 3) % 4]}, front, behind});
        }
      }
    }
  }
  return skin;
}

// The volume of a region, by its walls, and what rounding may have made of it.
struct VolumeByWalls {
  double volume = 0, error = 0;
};
inline VolumeByWalls volume_of(const Skin& skin, RegionId region) {
  VolumeByWalls sum;
  const Vec3 origin = skin.points[skin.walls[0].v[0]];
  for (const Wall& wall : skin.walls) {
    if (wall.behind != region && wall.front != region) continue;
    const Vec3 a = skin.points[wall.v[0]] - origin, b = skin.points[wall.v[1]] - origin,
               c = skin.points[wall.v[2]] - origin;
    sum.volume += (wall.behind == region ? 1 : -1) * dot(a, cross(b, c)) / 6;
    sum.error += 1e-15 * length(a) * length(b) * length(c);
  }
  return sum;
}

inline TriMesh surface_of(const Skin& skin) {
  std::vector<Triangle> triangles;
  for (const Wall& wall : skin.walls) triangles.push_back(wall.v);
  return make_tri_mesh(skin.points, triangles);
}

inline std::string faults_of(const SolidCheck& check) {
  std::string all;
  for (const auto& row : kSolidFaultTable) {
    if (check.faults.count(row.value) == 0) continue;
    all += std::to_string(check.faults.count(row.value)) + " " + std::string(row.words) + ": " +
           check.faults.first(row.value)[0].what + "; ";
  }
  return all;
}

// Points that only the skin has are no fault of the solid.
inline Skin without_unused(Skin skin) {
  IdArray<VertexId, VertexId> number(skin.points.size(), kNoId);
  std::vector<Vec3> points;
  for (Wall& wall : skin.walls) {
    for (VertexId& v : wall.v) {
      if (number[v] == kNoId) {
        number[v] = VertexId(points.size());
        points.push_back(skin.points[v]);
      }
      v = number[v];
    }
  }
  skin.points = std::move(points);
  return skin;
}

// Gives each wall its number, from 1 on, as its kind.
inline Skin numbered(Skin skin) {
  for (std::size_t w = 0; w < skin.walls.size(); ++w) {
    skin.walls[w].kind = static_cast<std::uint32_t>(w + 1);
  }
  return skin;
}

// The squared distance of p from a triangle. From a needle that function alone is off by far, so
// its sides are asked, too: they are no nearer than the triangle.
inline double distance2_to_wall(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_side = [&](const Vec3& from, const Vec3& to) {
    const Vec3 side = to - from;
    return distance2(p, from + std::clamp(dot(p - from, side) / length2(side), 0., 1.) * side);
  };
  return std::min({distance2_to_triangle(p, a, b, c), to_side(a, b), to_side(b, c), to_side(c, a)});
}

// Checks the solid against its skin: sound, with the skin's triangles, and each region with the
// volume that its walls enclose.
inline SolidCheck check_against(const Solid& solid, const Skin& skin) {
  const TriMesh surface = surface_of(skin);
  const SolidCheck check = check_solid(solid, {.surface = &surface});
  CHECK(faults_of(check) == "");
  CHECK(check.surface.whole + check.surface.cut == skin.walls.size());
  CHECK(check.region_facets + check.border_facets == solid.walls.size());
  if (solid.recovery.cut_edges + solid.recovery.cut_walls == 0) {
    CHECK(check.surface.whole == skin.walls.size());
    CHECK(solid.walls.size() == skin.walls.size());
  }
  for (RegionId r = 1; r < check.regions.size(); ++r) {
    const auto [volume, error] = volume_of(skin, r);
    CHECK(std::fabs(check.regions[r].volume - volume) <= 1e-12 * volume + error);
  }
  const bool is_numbered = skin.walls[0].kind == 1;
  std::size_t strayed = 0;  // walls that do not lie on the one whose kind they have
  for (const Wall& wall : solid.walls) {
    if (!is_numbered) break;
    REQUIRE((wall.kind >= 1 && wall.kind <= skin.walls.size()));
    const auto& [a, b, c] = skin.walls[wall.kind - 1].v;
    for (const VertexId v : wall.v) {
      strayed += distance2_to_wall(solid.points[v], skin.points[a], skin.points[b],
                                   skin.points[c]) > 1e-12;
    }
  }
  CHECK(strayed == 0);
  REQUIRE(solid.points.size() >= skin.points.size());
  CHECK(std::equal(skin.points.begin(), skin.points.end(), solid.points.begin()));
  return check;
}

inline Vec3 middle_of(const Solid& solid, std::size_t cell) {
  Vec3 sum;
  for (const VertexId v : solid.cells[cell]) sum = sum + solid.points[v];
  return .25 * sum;
}

}  // namespace deliso::test
