// SPDX-License-Identifier: MIT
// The triangulation against brute force, on many kinds of degenerate point sets.
#include "cases.h"
#include "delaunay/triangulation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "delaunay/check_triangulation.h"
#include "delaunay/point_sets.h"
#include "exact/big_int.h"

using namespace deliso;
using oracle::make_point_set;
using oracle::PointSet;

namespace {

constexpr int kKinds = static_cast<int>(PointSet::kCount);

std::size_t count_distinct(std::span<const Vec3> points) {
  std::set<std::tuple<double, double, double>> distinct;
  for (const Vec3& p : points) distinct.insert({p.x, p.y, p.z});
  return distinct.size();
}

// The sign of orient3d by the oracle with p in place of vertex i.
int exact_side(const Triangulation& t, CellId c, int i, const Vec3& p) {
  Vec3 corner[4];
  for (int k = 0; k < 4; ++k) corner[k] = k == i ? p : t.point(t.vertex(c, k));
  return oracle::orient3d(corner[0], corner[1], corner[2], corner[3]);
}

// The definition of conflict, by the oracle.
bool is_in_conflict(const Triangulation& t, CellId c, const Vec3& p) {
  const auto sphere = [&](CellId finite) {
    const auto& v = t.vertices(finite);
    return oracle::insphere(t.point(v[0]), t.point(v[1]), t.point(v[2]), t.point(v[3]), p) > 0;
  };
  const int i = t.infinite_index(c);
  if (i < 0) return sphere(c);
  const int s = exact_side(t, c, i, p);
  return s > 0 || (s == 0 && sphere(t.neighbor(c, i)));
}

void check_all(const Triangulation& t) {
  REQUIRE(check_triangulation(t) == "");
  REQUIRE(check_delaunay(t) == "");
}

}  // namespace

TEST_CASE("build: brute force finds no broken invariant on 300 point sets") {
  for (int trial = 0; trial < test::cases(300); ++trial) {
    CAPTURE(trial);
    const auto points =
        make_point_set(static_cast<PointSet>(trial % kKinds), 10 + trial % 97, trial);
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    check_all(t);
    CHECK(t.vertex_capacity() == 1 + count_distinct(points));
    for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(t.point(ids[i]) == points[i]);
  }
}

TEST_CASE("insert: every invariant after every insertion") {
  for (int trial = 0; trial < 4 * kKinds; ++trial) {
    CAPTURE(trial);
    const auto points = make_point_set(static_cast<PointSet>(trial % kKinds), 40, 1000 + trial);
    // Start from as few points as span space, then go on in any order with any hint.
    Triangulation t;
    std::vector<SiteId> ids;
    std::size_t start = 4;
    while (!t.build(std::span(points).first(start), ids)) ++start;
    Random random(trial);
    for (std::size_t i = start; i < points.size(); ++i) {
      CAPTURE(i);
      const CellId hint(random.below(3) == 0
                            ? kNoId
                            : random.below(static_cast<std::uint32_t>(t.cell_capacity())));
      const std::size_t before = t.vertex_capacity();
      const SiteId v = t.insert(points[i], hint);
      REQUIRE(t.point(v) == points[i]);
      const bool is_new = v >= before;
      REQUIRE(t.vertex_capacity() == before + is_new);
      REQUIRE(is_new ==
              (std::find(points.begin(), points.begin() + i, points[i]) == points.begin() + i));
      check_all(t);
    }
  }
}

TEST_CASE("find_conflicts finds the cells of the definition; insert_in_zone keeps its contract") {
  for (int trial = 0; trial < 12 * kKinds; ++trial) {
    CAPTURE(trial);
    const auto points = make_point_set(static_cast<PointSet>(trial % kKinds), 30, 2000 + trial);
    const std::size_t start = points.size() - 8;
    Triangulation t;
    std::vector<SiteId> ids;
    if (!t.build(std::span(points).first(start), ids)) continue;
    ConflictZone zone;
    std::vector<CellId> created;
    for (std::size_t i = start; i < points.size(); ++i) {
      const Vec3& p = points[i];
      t.find_conflicts(p, kNoId, zone);
      if (zone.duplicate != kNoId) {
        REQUIRE(t.point(zone.duplicate) == p);
        REQUIRE(zone.cells.empty());
        continue;
      }
      std::set<CellId> expected;
      for (CellId c = 0; c < t.cell_capacity(); ++c)
        if (t.is_live(c) && is_in_conflict(t, c, p)) expected.insert(c);
      REQUIRE(std::set(zone.cells.begin(), zone.cells.end()) == expected);
      REQUIRE(zone.cells.size() == expected.size());

      std::vector<std::array<SiteId, 4>> old_vertices;
      std::vector<Facet> outer;
      for (const Facet& f : zone.boundary) {
        REQUIRE(expected.contains(f.cell));
        REQUIRE(!expected.contains(t.neighbor(f.cell, f.index)));
        old_vertices.push_back(t.vertices(f.cell));
        outer.push_back(t.mirror(f));
      }
      const SiteId v = t.insert_in_zone(p, zone, created);
      REQUIRE(created.size() == zone.boundary.size());
      for (std::size_t k = 0; k < created.size(); ++k) {
        old_vertices[k][zone.boundary[k].index] = v;
        REQUIRE(t.vertices(created[k]) == old_vertices[k]);
        REQUIRE(t.mirror({created[k], zone.boundary[k].index}) == outer[k]);
      }
      for (CellId c : zone.cells)
        REQUIRE((!t.is_live(c) || std::find(created.begin(), created.end(), c) != created.end()));
    }
  }
}

TEST_CASE("zones too large for the table of vertex pairs are linked as well") {
  // The center of a sphere is in conflict with every cell of the points on it.
  std::vector<int> sizes{20, 40, 60, 70, 80, 100, 150, 210};
  // The table has room for 64 vertices.
  for (int size = 62; size <= 67; ++size) sizes.insert(sizes.end(), 3, size);
  for (int trial = 0; trial < static_cast<int>(sizes.size()); ++trial) {
    CAPTURE(trial);
    const auto points = make_point_set(PointSet::kOnSphere, sizes[trial], 6000 + trial);
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    ConflictZone zone;
    std::vector<CellId> created;
    t.find_conflicts({3, 4, 5}, kNoId, zone);
    CHECK(zone.boundary.size() == 2 * points.size() - 4);
    t.insert_in_zone({3, 4, 5}, zone, created);
    check_all(t);
    t.insert({3.5, 4, 5});
    check_all(t);
  }
}

TEST_CASE("locate finds a cell that holds the point, from any hint") {
  for (int trial = 0; trial < 4 * kKinds; ++trial) {
    CAPTURE(trial);
    const auto points = make_point_set(static_cast<PointSet>(trial % kKinds), 100, 3000 + trial);
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    Random random(trial);
    for (int query = 0; query < 200; ++query) {
      const auto any = [&] {
        return points[random.below(static_cast<std::uint32_t>(points.size()))];
      };
      // Vertices, midpoints (on facets and edges of grids), points around and far away.
      Vec3 p = any();
      if (query % 4 == 1) p = 0.5 * (p + any());
      if (query % 4 == 2) p = p + 1.5 * (any() - any());
      if (query % 4 == 3) p = 100 * p;
      std::size_t walked = 0;
      const CellId c = t.locate(
          p, CellId(random.below(static_cast<std::uint32_t>(t.cell_capacity() + 1))), walked);
      REQUIRE(t.is_live(c));
      const int infinite = t.infinite_index(c);
      if (infinite >= 0) {
        REQUIRE(exact_side(t, c, infinite, p) > 0);
      } else {
        for (int i = 0; i < 4; ++i) REQUIRE(exact_side(t, c, i, p) >= 0);
      }
    }
  }
}

TEST_CASE("point sets without volume are refused") {
  Triangulation t;
  std::vector<SiteId> ids;
  std::vector<Vec3> points;
  CHECK(!t.build(points, ids));
  for (int i = 0; i < 50; ++i) points.push_back({0.1 * i, 0.2 * i, 0.4 * i});  // exactly a line
  CHECK(!t.build(points, ids));
  for (int i = 0; i < 50; ++i) points.push_back({0.1 * i, 3, 0.4 * i});
  for (Vec3& p : points) p.y = 7;
  CHECK(!t.build(points, ids));
  CHECK(t.vertex_capacity() == 0);
  points.assign(10, Vec3{1, 2, 3});
  CHECK(!t.build(points, ids));

  // The same object serves again.
  CHECK(t.build(make_point_set(PointSet::kRandom, 50, 1), ids));
  check_all(t);
}

TEST_CASE("build gives the same triangulation every time") {
  for (int kind = 0; kind < kKinds; ++kind) {
    CAPTURE(kind);
    const auto points = make_point_set(static_cast<PointSet>(kind), 300, 17);
    Triangulation a, b;
    std::vector<SiteId> ids_a, ids_b;
    REQUIRE(a.build(points, ids_a));
    REQUIRE(b.build(make_point_set(PointSet::kRandom, 100, 3), ids_b));
    REQUIRE(b.build(points, ids_b));
    REQUIRE(ids_a == ids_b);
    REQUIRE(a.cell_capacity() == b.cell_capacity());
    for (CellId c = 0; c < a.cell_capacity(); ++c) {
      REQUIRE(a.vertices(c) == b.vertices(c));
      if (a.is_live(c))
        for (int i = 0; i < 4; ++i) REQUIRE(a.mirror({c, i}) == b.mirror({c, i}));
    }
  }
}
