// SPDX-License-Identifier: MIT
// Skins that are hard to recover, and such as are none.
#include "more/solids/recover.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "cases.h"
#include "more/solids/skins.h"

using namespace deliso;
using namespace deliso::test;

namespace {

const std::vector<Triangle> kBox{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                 {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

Skin box_skin(const Vec3& lo, const Vec3& hi, RegionId region = 1) {
  Skin skin = skin_of({lo,
                       {hi.x, lo.y, lo.z},
                       {hi.x, hi.y, lo.z},
                       {lo.x, hi.y, lo.z},
                       {lo.x, lo.y, hi.z},
                       {hi.x, lo.y, hi.z},
                       hi,
                       {lo.x, hi.y, hi.z}},
                      kBox);
  for (Wall& wall : skin.walls) wall.behind = region;
  return skin;
}

void turn_inside_out(Skin& skin) {
  for (Wall& wall : skin.walls) std::swap(wall.front, wall.behind);
}

// A prism whose sides are bent inwards, by the angle of its twist: of its vertices alone there is
// no mesh of tetrahedra (Schönhardt 1928).
Skin twisted_prism(double twist) {
  std::vector<Vec3> points;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * std::numbers::pi / 3 * (k % 3) + (k < 3 ? 0 : twist);
    points.push_back({std::cos(angle), std::sin(angle), k < 3 ? 0. : 1.});
  }
  std::vector<Triangle> triangles{{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    // The diagonal from k to the next one above bends inwards if the top is turned on.
    triangles.push_back(triangle_of(k, next, next + 3));
    triangles.push_back(triangle_of(k, next + 3, k + 3));
  }
  return skin_of(points, triangles);
}

// Whether make_solid() throws, and its words.
std::string refusal_of(const Skin& skin) {
  try {
    make_solid(skin, {});
  } catch (const SkinError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a wall that no mesh of the vertices alone has is recovered: Schönhardt's prism") {
  for (const double degrees : {10., 30., 40., 55., -30., -50.}) {
    CAPTURE(degrees);
    const Skin skin = numbered(twisted_prism(degrees * std::numbers::pi / 180));
    for (const bool fills : {false, true}) {
      SolidOptions options;
      options.fills = fills;
      const Solid solid = make_solid(skin, options);
      check_against(solid, skin);
    }
  }
  SolidOptions options;
  options.fills = false;
  const Skin skin = twisted_prism(std::numbers::pi / 6);
  const Solid solid = make_solid(skin, options);
  CHECK(volume_of(skin, 1).volume > 0);
  CHECK(solid.points.size() > 6);
}

TEST_CASE("two boxes that share an edge, a corner, or a face") {
  for (const RegionId second : {1u, 2u}) {
    for (const Vec3& shift : {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{1, 0, 0}}) {
      Skin skin = box_skin({0, 0, 0}, {1, 1, 1});
      append(skin, box_skin(shift, shift + Vec3{1, 1, 1}, second));
      if (shift == Vec3{1, 0, 0}) {
        // The face between: no wall if both are one region, else one in the place of two.
        std::erase_if(skin.walls, [&](const Wall& wall) {
          return wall.behind == second &&
                 std::ranges::all_of(wall.v, [&](VertexId v) { return skin.points[v].x == 1; });
        });
        for (Wall& wall : skin.walls) {
          if (std::ranges::all_of(wall.v, [&](VertexId v) { return skin.points[v].x == 1; })) {
            wall.front = second;
          }
        }
      }
      const Solid solid = make_solid(skin, {});
      check_against(solid, skin);
      double volume = 0;
      for (const RegionVolume& region : check_solid(solid).regions) volume += region.volume;
      CHECK(volume == doctest::Approx(2).epsilon(1e-12));
    }
  }
}

TEST_CASE("nested shells: a cavity, a region in it, and a region all around") {
  Skin skin = box_skin({0, 0, 0}, {10, 10, 10});
  Skin cavity = box_skin({2, 2, 2}, {8, 8, 8});
  turn_inside_out(cavity);
  append(skin, cavity);
  append(skin, box_skin({3, 3, 3}, {7, 7, 7}, 2));
  Skin core = box_skin({4, 4, 4}, {6, 6, 6}, 3);
  for (Wall& wall : core.walls) wall.front = 2;
  append(skin, core);
  const Solid solid = make_solid(skin, {});
  const SolidCheck check = check_against(solid, skin);
  REQUIRE(check.regions.size() == 4);
  CHECK(check.regions[1].volume == doctest::Approx(1000 - 216).epsilon(1e-12));
  CHECK(check.regions[2].volume == doctest::Approx(64 - 8).epsilon(1e-12));
  CHECK(check.regions[3].volume == doctest::Approx(8).epsilon(1e-12));
}

namespace {

// Boxes of this thickness, and as far apart, one over the other and shifted.
Skin pages(int count, double gap) {
  Skin skin = box_skin({0, 0, 0}, {1, 1, gap});
  for (int k = 1; k < count; ++k) {
    append(skin,
           box_skin({.1 * k, .03 * k, 2 * gap * k}, {1 + .1 * k, 1 + .07 * k, 2 * gap * k + gap}));
  }
  return skin;
}

}  // namespace

TEST_CASE("pages and needles near each other") {
  for (const Skin& given : {pages(6, .1), pages(2, .01), pages(2, .001), pages(2, 1e-4)}) {
    const Skin skin = numbered(given);
    check_against(make_solid(skin, {}), skin);
  }
  for (const double gap : {.1, .01, .001}) {
    CAPTURE(gap);
    Skin skin = box_skin({0, 0, 0}, {gap, gap, 1});
    append(skin, box_skin({2 * gap, 0, .3}, {3 * gap, gap, 1.3}));
    append(skin, box_skin({-1, 2 * gap, .5}, {1, 3 * gap, .5 + gap}));
    check_against(make_solid(skin, {}), skin);
  }
}

// Where a neighbor is a rounding away, the facets of a wall can be folded: it is tried again.
TEST_CASE("turned pages that are up to a rounding near are filled without a fault, or refused") {
  int filled = 0;
  const std::uint64_t count = cases(100u);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int pages_count = 2 + static_cast<int>(random.below(4));
    Skin skin = pages(pages_count, std::pow(10., random.uniform(-15, -2)));
    const double turn = random.uniform(0, 3), tilt = random.uniform(0, 3);
    for (Vec3& p : skin.points) {
      p = {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y,
           p.z};
      p = {p.x, std::cos(tilt) * p.y - std::sin(tilt) * p.z,
           std::sin(tilt) * p.y + std::cos(tilt) * p.z};
    }
    if (refusal_of(skin) != "") continue;
    ++filled;
    check_against(make_solid(skin, {}), skin);
  }
  CHECK(filled > static_cast<int>(count / 2));
}

TEST_CASE("three pages a thousandth apart") {
  const Skin skin = pages(3, .001);
  check_against(make_solid(skin, {}), skin);
}

// A dozen tetrahedra as thin as 1e-10 that pass each other. Cutting walls into parts, whose rounded
// edges were cut again, did not end: the skin was refused.
TEST_CASE("needles that pass each other") {
  Random random(51);
  const double width = std::pow(10., random.uniform(-12, -1));
  const std::uint64_t count = 5 + random.below(30);
  Skin skin;
  const auto vector = [&](double least) {
    const double x = random.uniform(least, 1), y = random.uniform(least, 1);
    return Vec3{x, y, random.uniform(least, 1)};
  };
  for (std::uint64_t k = 0; k < count; ++k) {
    const Vec3 a = vector(0), along = vector(-1), b = a + width * vector(-1);
    std::vector<Vec3> p{a, b, a + along, a + along + width * vector(-1)};
    if (dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0) std::swap(p[2], p[3]);
    append(skin, skin_of(p, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  }
  const Solid solid = make_solid(skin, {});
  check_against(solid, skin);
  CHECK(solid.recovery.missing_walls > 0);
}

TEST_CASE("random tetrahedra that do not meet, thin and long, in one solid") {
  for (std::uint64_t seed = 1; seed <= cases(100u); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Skin skin;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 8; ++k) {
        // Each in a box of its own.
        const Vec3 low{10. * i, 1.05 * (k % 2), 1.05 * (k / 2)};
        std::vector<Vec3> p;
        for (int n = 0; n < 4; ++n) {
          p.push_back(low + Vec3{random.uniform(0, 9.99), random.uniform(), random.uniform()});
        }
        if (dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0) std::swap(p[2], p[3]);
        append(skin, skin_of(p, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
      }
    }
    check_against(make_solid(skin, {}), skin);
  }
}

TEST_CASE("a skin that crosses itself is refused") {
  Skin skin = box_skin({0, 0, 0}, {2, 2, 2});
  append(skin, box_skin({1, 1.1, 1.2}, {3, 3.1, 3.2}));
  CHECK(refusal_of(skin) == "it crosses itself, or has sheets a rounding apart");
  // An edge through a wall.
  skin = box_skin({0, 0, 0}, {2, 2, 2});
  append(skin, skin_of({{1, 1, 1}, {1.1, 1, 5}, {1, 1.2, 5}, {1.1, 1.2, 4}},
                       {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
  CHECK(refusal_of(skin) != "");
}

TEST_CASE("an open skin is refused, and one whose sides do not agree") {
  Random random(2);
  const Skin whole = cubes_skin(
      3, [](int, int, int) { return 1u; }, random);
  CHECK(refusal_of(whole) == "");
  for (std::size_t w = 0; w < whole.walls.size(); ++w) {
    Skin skin = whole;
    skin.walls.erase(skin.walls.begin() + static_cast<std::ptrdiff_t>(w));
    CHECK(refusal_of(skin) != "");
    skin = whole;
    std::swap(skin.walls[w].front, skin.walls[w].behind);
    CHECK(refusal_of(skin) != "");
    skin = whole;
    skin.walls[w].behind = 2;
    CHECK(refusal_of(skin) != "");
  }
  Skin skin = whole;
  turn_inside_out(skin);
  CHECK(refusal_of(skin) != "");
}

TEST_CASE("points in one plane and points at one place are refused") {
  const Skin flat = skin_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  CHECK(refusal_of(flat) != "");
  Skin twice = box_skin({0, 0, 0}, {1, 1, 1});
  twice.points.push_back(twice.points[3]);
  twice.walls[1].v[1] = 8;
  CHECK(refusal_of(twice) == "two of its points lie at one place");
}
