// SPDX-License-Identifier: MIT
// A sound solid has no faults; one change makes the fault that it is, and the figures are those of
// known solids.
#include "check/check_solid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "io/solid/solids.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Puts b beside a, with points of its own.
Solid both(const Solid& a, Solid b) {
  Solid sum = a;
  const auto first = static_cast<std::uint32_t>(a.points.size());
  for (const Vec3& p : b.points) sum.points.push_back(p);
  for (Tetrahedron& cell : b.cells) {
    for (VertexId& v : cell) v = VertexId(v + first);
    sum.cells.push_back(cell);
  }
  for (const RegionId r : b.regions) sum.regions.push_back(r);
  for (Wall wall : b.walls) {
    for (VertexId& v : wall.v) v = VertexId(v + first);
    sum.walls.push_back(wall);
  }
  return sum;
}

Solid moved(Solid solid, double scale, const Vec3& by) {
  for (Vec3& p : solid.points) p = scale * p + by;
  return solid;
}

std::string kinds_of(const SolidCheck& check) {
  std::string all;
  for (const auto& row : kSolidFaultTable) {
    if (check.faults.count(row.value) > 0) all += text(row.words, "; ");
  }
  return all;
}
std::string kinds_of(const Solid& solid) {
  return kinds_of(check_solid(solid));
}

TriMesh surface_of(const Solid& solid) {
  std::vector<Triangle> triangles;
  for (const Wall& wall : solid.walls) triangles.push_back(wall.v);
  return make_tri_mesh(solid.points, triangles);
}

Solid regular_tetrahedron() {
  Solid solid;
  const double r = std::sqrt(.5);
  solid.points = {{1, 0, -r}, {-1, 0, -r}, {0, 1, r}, {0, -1, r}};
  solid.cells = {{0, 1, 3, 2}};
  solid.regions = {1};
  set_walls(solid);
  return solid;
}

}  // namespace

TEST_CASE("sound solids have no faults, and the figures that are known") {
  const SolidCheck one = check_solid(regular_tetrahedron());
  CHECK(kinds_of(one) == "");
  CHECK(one.volume == doctest::Approx(std::sqrt(8.) / 3));
  const double angle = std::acos(1. / 3) * 180 / 3.14159265358979;
  for (const double found :
       {one.angles.least, one.angles.at_1_percent, one.angles.at_5_percent, one.angles.largest}) {
    CHECK(found == doctest::Approx(angle));
  }
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Solid solid = cube(1 + static_cast<RegionId>(seed % 4), seed);
    const TriMesh surface = surface_of(solid);
    const SolidCheck check = check_solid(solid, {.surface = &surface});
    CHECK(kinds_of(check) == "");
    CHECK(check.border_facets == 12);
    CHECK(check.border_facets + check.region_facets == solid.walls.size());
    CHECK(check.surface.whole == solid.walls.size());
    CHECK(check.surface.cut == 0);
    double sum = 0;
    for (const RegionVolume& region : check.regions) sum += region.volume;
    CHECK(check.volume == doctest::Approx(sum).epsilon(1e-14));
  }
}

TEST_CASE("each fault is found") {
  const Solid sound = cube(2, 3);
  Solid solid = sound;
  std::swap(solid.cells[2][0], solid.cells[2][1]);
  CHECK(kinds_of(solid).starts_with("cells not positive; one-sided facets; "));
  solid = sound;
  solid.points[1] = solid.points[3];
  CHECK(kinds_of(solid).starts_with("duplicate points; cells not positive; "));
  solid = sound;
  solid.points[2].y = std::nan("");
  CHECK(kinds_of(solid) == "points not finite; ");
  solid = sound;
  solid.points.push_back({3, 3, 3});
  CHECK(kinds_of(solid) == "unused points; ");
  solid = sound;
  solid.cells.push_back(solid.cells[0]);
  solid.regions.push_back(solid.regions[0]);
  CHECK(kinds_of(solid).starts_with("crowded facets; one-sided facets; "));
  // A cell is gone: the border has other facets than walls.
  solid = sound;
  solid.cells.pop_back();
  solid.regions.pop_back();
  CHECK(kinds_of(solid) == "missing walls; extra walls; turned walls; ");
  solid = sound;
  solid.walls.pop_back();
  CHECK(kinds_of(solid) == "missing walls; ");
  solid = sound;
  solid.walls.push_back(solid.walls[0]);
  CHECK(kinds_of(solid) == "extra walls; ");
  for (std::size_t w = 0; w < sound.walls.size(); ++w) {
    solid = sound;
    std::swap(solid.walls[w].v[0], solid.walls[w].v[1]);
    CHECK(kinds_of(solid) == "turned walls; ");
    std::swap(solid.walls[w].front, solid.walls[w].behind);
    CHECK(kinds_of(solid) == "");
    solid.walls[w].front = solid.walls[w].behind = kOutside;  // sides that are not known
    CHECK(kinds_of(solid) == "");
  }
  // A region that is another one's.
  solid = sound;
  solid.regions[0] = 2;
  CHECK(kinds_of(solid).find("walls") != std::string::npos);
}

TEST_CASE("solids that overlap: their borders cross, or one is in the other") {
  const Solid one = cube(1, 4);
  CHECK(kinds_of(both(one, moved(one, 1, {2, 0, 0}))) == "");
  CHECK(kinds_of(both(one, moved(one, 1, {.4, .3, .2}))) == "border crossings; ");
  CHECK(kinds_of(both(one, moved(one, .1, {.45, .45, .45}))) == "nested pieces; ");
  CHECK(kinds_of(both(one, moved(one, .1, {.45, .45, 1.45}))) == "");
}

TEST_CASE("a cavity is none of these, and what lies in it alone neither") {
  // A box of cubes without its middle one, each cube cut alike.
  Solid shell;
  const auto number = [](int i, int j, int k) {
    return static_cast<std::uint32_t>(i + 4 * (j + 4 * k));
  };
  for (int n = 0; n < 64; ++n)
    shell.points.push_back({1. * (n % 4), 1. * (n / 4 % 4), 1. * (n / 16)});
  for (int n = 0; n < 27; ++n) {
    if (n == 13) continue;
    const Solid unit = cube(1);
    for (const Tetrahedron& cell : unit.cells) {
      Tetrahedron placed;
      for (std::size_t c = 0; c < 4; ++c) {
        const auto bits = static_cast<int>(cell[c]);
        placed[c] =
            VertexId(number(n % 3 + (bits & 1), n / 3 % 3 + (bits >> 1 & 1), n / 9 + (bits >> 2)));
      }
      shell.cells.push_back(placed);
      shell.regions.push_back(1);
    }
  }
  set_walls(shell);
  CHECK(kinds_of(shell) == "");
  CHECK(check_solid(shell).border_facets == 12 * 9 + 12);
  CHECK(kinds_of(both(shell, moved(cube(1), .1, {1.4, 1.4, 1.4}))) == "");
  CHECK(kinds_of(both(shell, moved(cube(1), .1, {.4, .4, .4}))) == "nested pieces; ");
  CHECK(kinds_of(both(shell, moved(cube(1), 10, {-5, -5, -5}))) == "nested pieces; ");
}

TEST_CASE("triangles of the surface are facets, or tiled by facets, or lost") {
  // One tetrahedron cut in two at the middle of an edge, then against the whole one.
  const Solid whole = regular_tetrahedron();
  const TriMesh surface = surface_of(whole);
  Solid halves = whole;
  halves.points.push_back(.5 * (whole.points[0] + whole.points[1]));
  halves.cells = {{0, 4, 3, 2}, {4, 1, 3, 2}};
  halves.regions = {1, 1};
  halves.walls.clear();
  set_walls(halves);
  SolidCheck check = check_solid(halves, {.surface = &surface});
  CHECK(kinds_of(check) == "");
  CHECK(check.surface.whole == 2);
  CHECK(check.surface.cut == 2);
  CHECK(check.surface.parts == 4);
  CHECK(check.surface.largest_offset < 1e-15);
  // The cut a little aside is no cut.
  for (const Vec3& aside : {Vec3{0, 0, 1e-9}, Vec3{0, 1e-9, 0}, Vec3{0, 0, -1e-9}}) {
    Solid bent = halves;
    bent.points[4] = bent.points[4] + aside;
    CHECK(kinds_of(check_solid(bent, {.surface = &surface})) == "lost triangles; extra facets; ");
    CHECK(kinds_of(check_solid(bent, {.surface = &surface, .cut_tolerance = 1e-8})) == "");
  }
  // Half of it: two triangles are half covered, one is lost, and one facet is inside.
  halves.cells.pop_back();
  halves.regions.pop_back();
  halves.walls.clear();
  check = check_solid(halves, {.surface = &surface});
  CHECK(check.faults.count(SolidFaultKind::lost_triangles) == 3);
  CHECK(check.faults.count(SolidFaultKind::extra_facets) == 1);
}
