// SPDX-License-Identifier: MIT
// Facets above and between flat sheets, where the right surface point is known.
#include "surface/surface_point.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "volume/sampled.h"

using namespace deliso;

namespace {

constexpr int kSide = 13;
constexpr double kUpper = 6.5, kTop = 7.5;  // of the wall

// All below `ground(i, j)` is inside. With a wall, so is what lies between kUpper and kTop. Sheets
// over samples are where linear interpolation along z has them.
template <class Ground>
Volume world(bool has_wall, Ground&& ground) {
  return sampled<float>({kSide, kSide, kSide}, {1, 1, 1}, [&](int i, int j, int k) {
    const double below = ground(i, j) - k, within = std::min(k - kUpper, kTop - k);
    return has_wall ? std::max(below, within) : below;
  });
}

Volume flat_world(bool has_wall, double ground) {
  return world(has_wall, [=](int, int) { return ground; });
}

struct Finder {
  explicit Finder(Volume v) : volume(std::move(v)), surface(volume, 0) {}
  Finder(const Finder&) = delete;

  Volume volume;
  Isosurface surface;
  SurfacePointFinder finder{surface};
  SearchCounters counters;
};

// An equilateral triangle about (6, 6), at height z, counter-clockwise from above.
struct Corners3 {
  Vec3 a, b, c;
};
Corners3 facet_at(double z, double radius) {
  const double half = 0.5 * std::sqrt(3.0) * radius;
  return {{6 + radius, 6, z}, {6 - 0.5 * radius, 6 + half, z}, {6 - 0.5 * radius, 6 - half, z}};
}

bool is_at(const std::optional<Vec3>& found, const Vec3& expected) {
  return found && distance(*found, expected) < 1e-9;
}

}  // namespace

TEST_CASE(
    "the surface point lies over the circumcenter, on the sheet that faces as the facet does") {
  Finder at(flat_world(false, 5.5));
  for (const double z : {4.75, 5.5, 6.25}) {
    CAPTURE(z);
    const auto [a, b, c] = facet_at(z, 3);
    CHECK(is_at(at.finder.find(a, b, c, at.counters), {6, 6, 5.5}));
    CHECK(is_at(at.finder.find(b, c, a, at.counters), {6, 6, 5.5}));
    // Seen from outside the corners turn the other way: the facet faces into the solid.
    CHECK_FALSE(at.finder.find(a, c, b, at.counters));
  }
}

TEST_CASE("the sheet across a gap is passed over, though it is nearer") {
  // A gap of 1 between the ground at 5.5 and the wall's lower side at 6.5.
  Finder at(flat_world(true, 5.5));
  const auto [a, b, c] = facet_at(6.25, 3);
  CHECK(is_at(at.finder.find(a, b, c, at.counters), {6, 6, 5.5}));
  CHECK(is_at(at.finder.find(a, c, b, at.counters), {6, 6, kUpper}));
  // Nearest with a direction says the same.
  CHECK(is_at(at.finder.nearest({6, 6, 6.25}, {0, 0, 1}, 3, at.counters), {6, 6, 5.5}));
  CHECK(is_at(at.finder.nearest({6, 6, 6.25}, {0, 0, -1}, 3, at.counters), {6, 6, kUpper}));
  CHECK_FALSE(at.finder.nearest({6, 6, 6.25}, {0, 0, 1}, 0.5, at.counters));
}

TEST_CASE("the sheet behind that one is no surface point, though it faces as the facet does") {
  // The corners are on the ground, the circumcenter over a pit: the wall's upper side is nearer
  // than the pit's floor.
  const auto pit = [](int i, int j) { return std::hypot(i - 6, j - 6) < 2.25 ? 2.75 : 5.5; };
  const auto [a, b, c] = facet_at(5.5, 3);
  Finder with_wall(world(true, pit)), without(world(false, pit));
  CHECK_FALSE(with_wall.finder.find(a, b, c, with_wall.counters));
  CHECK_FALSE(with_wall.finder.leads_to(a, {6, 6, kTop}));
  CHECK_FALSE(with_wall.finder.leads_to(a, {6, 6, kUpper}));
  // As far, and on the facet's own sheet.
  CHECK(is_at(without.finder.find(a, b, c, without.counters), {6, 6, 2.75}));
}

TEST_CASE("no surface point is further away than the circumradius and the longest edge") {
  Finder at(flat_world(false, 5.5));
  for (const double radius : {1.0, 2.0, 4.0}) {
    const auto [a, b, c] = facet_at(3, radius);
    CHECK(at.finder.find(a, b, c, at.counters).has_value() == (radius > 2.5));
  }
  // A needle: its longest edge is 2, its circumradius 4.1, and its circumcenter (5, 0.1).
  const auto needle = [&](double z) {
    return at.finder.find({4, 4, z}, {6, 4, z}, {5, 4.125, z}, at.counters);
  };
  CHECK(is_at(needle(4), {5, 4.125 - (1 + 0.015625) / 0.25, 5.5}));
  CHECK_FALSE(needle(2));
}

TEST_CASE("a facet without area has no surface point") {
  Finder at(flat_world(false, 5.5));
  CHECK_FALSE(at.finder.find({3, 3, 5}, {5, 5, 5}, {7, 7, 5}, at.counters));
  CHECK_FALSE(at.finder.find({3, 3, 5}, {3, 3, 5}, {7, 6, 5}, at.counters));
  CHECK(at.counters.searches == 0);
}

TEST_CASE("the dual is a ball through the furthest corner, about the surface point or the center") {
  Finder at(flat_world(false, 5.5));
  const auto [a, b, c] = facet_at(5, 3);
  const Dual dual = at.finder.dual(a, b, c, at.counters);
  CHECK(dual.on_surface);
  CHECK(distance(dual.center, {6, 6, 5.5}) < 1e-9);
  CHECK(dual.radius2 == doctest::Approx(9.25));
  const Dual none = at.finder.dual(a, c, b, at.counters);
  CHECK_FALSE(none.on_surface);
  CHECK(distance(none.center, {6, 6, 5}) < 1e-9);
  CHECK(none.radius2 == doctest::Approx(9));
  CHECK(dual_at({0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {0, 0, 1}).radius2 == 26);
}

TEST_CASE("a foot is the nearest point of a tilted plane, if that faces as asked and is near") {
  const Vec3 out = Vec3{1, 2, 2} / 3.0;
  Finder at(sampled<double>({kSide, kSide, kSide}, {1, 1, 1}, [&](int i, int j, int k) {
    return 15 - dot(Vec3{double(i), double(j), double(k)}, out);
  }));
  const Vec3 on_plane = 15.0 * out;
  for (const double off : {-1.5, -0.2, 0.3, 1.5}) {
    CAPTURE(off);
    const Vec3 from = on_plane + off * out;
    CHECK(is_at(at.finder.foot(from, out, 2, at.counters), on_plane));
    // Within a right angle of the normal.
    CHECK(is_at(at.finder.foot(from, {1, 0, 0}, 2, at.counters), on_plane));
    CHECK_FALSE(at.finder.foot(from, -1.0 * out, 2, at.counters));
    CHECK(at.finder.foot(from, out, 1, at.counters).has_value() == (std::abs(off) < 1));
  }
  // Where the samples are all the same there is no steepest line.
  Finder plateau(
      sampled<float>({5, 5, 5}, {1, 1, 1}, [](int, int, int k) { return k < 3 ? 1 : -1; }));
  CHECK_FALSE(plateau.finder.foot({1.5, 1.5, 0.5}, {0, 0, 1}, 4, plateau.counters));
}

TEST_CASE("Sigma leads along one sheet, and not to another that faces the same way") {
  // Two hills with a gap between them: the chord of their tops meets no sheet that faces away.
  Finder hills(world(false, [](int i, int) { return i == 6 ? 1.25 : 8.25; }));
  CHECK(hills.finder.leads_to({1, 6, 8.25}, {4, 6, 8.25}));
  CHECK_FALSE(hills.finder.leads_to({4, 6, 8.25}, {8, 6, 8.25}));
}
