// SPDX-License-Identifier: MIT
// The checkers must find every broken rule: break one at a time.
#include "delaunay/check_triangulation.h"

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "delaunay/point_sets.h"

namespace deliso {

// The friend of Triangulation that may break it.
class TriangulationVandal {
 public:
  explicit TriangulationVandal(Triangulation& t) : t_(t) {}
  void relink(CellId c, int i, Facet f) { t_.cells_[c].links[i] = Triangulation::link(f); }
  void swap_vertices(CellId c, int i, int j) {
    std::swap(t_.cells_[c].vertices[i], t_.cells_[c].vertices[j]);
  }
  void set_vertex(CellId c, int i, SiteId v) { t_.cells_[c].vertices[i] = v; }
  void remove(CellId c) { t_.cells_[c].vertices[0] = kNoId; }
  void move(SiteId v, const Vec3& p) { t_.points_[v] = p; }
  void set_incident(SiteId v, CellId c) { t_.incident_[v] = c; }
  void add_point(const Vec3& p) {
    t_.points_.push_back(p);
    t_.incident_.push_back(0);
  }

 private:
  Triangulation& t_;
};

}  // namespace deliso

using namespace deliso;

namespace {

struct Fixture {
  Triangulation t;
  TriangulationVandal vandal{t};
  std::vector<SiteId> ids;
  CellId finite = 0, infinite = 0;

  Fixture() {
    REQUIRE(t.build(oracle::make_point_set(oracle::PointSet::kRandom, 30, 9), ids));
    REQUIRE(check_triangulation(t) == "");
    REQUIRE(check_delaunay(t) == "");
    while (!t.is_live(finite) || t.is_infinite(finite)) ++finite;
    while (!t.is_live(infinite) || !t.is_infinite(infinite)) ++infinite;
  }
  // Links follow the vertices, so that only the orientation is wrong.
  void turn_over(CellId c, int i, int j) {
    const Facet f = t.mirror({c, i}), g = t.mirror({c, j});
    vandal.swap_vertices(c, i, j);
    vandal.relink(c, i, g);
    vandal.relink(c, j, f);
    vandal.relink(f.cell, f.index, {c, j});
    vandal.relink(g.cell, g.index, {c, i});
  }
  void expect(const std::string& rule) {
    const std::string found = check_triangulation(t);
    CHECK_MESSAGE(found.starts_with(rule), found);
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "I1: a link to a wrong facet") {
  vandal.relink(finite, 2, t.mirror({finite, 1}));
  expect("I1");
}

TEST_CASE_FIXTURE(Fixture, "I1: a missing cell") {
  vandal.remove(finite);
  expect("I1");
}

TEST_CASE_FIXTURE(Fixture, "I1: a vertex twice in a cell") {
  vandal.set_vertex(finite, 2, t.vertex(finite, 3));
  expect("I1");
}

TEST_CASE_FIXTURE(Fixture, "I2: a finite cell of negative orientation") {
  turn_over(finite, 0, 1);
  expect("I2");
}

TEST_CASE_FIXTURE(Fixture, "I2: a cell at infinity of negative orientation") {
  turn_over(infinite, 1, 2);
  expect("I2");
}

TEST_CASE_FIXTURE(Fixture, "I5: the infinite vertex not the first") {
  turn_over(infinite, 0, 1);
  expect("I5");
}

TEST_CASE_FIXTURE(Fixture, "I4: an incident cell that does not hold its vertex") {
  const SiteId v = t.vertex(finite, 0) == 0 ? t.vertex(finite, 1) : t.vertex(finite, 0);
  CellId c = 0;
  const auto holds = [&](CellId cell) {
    for (SiteId w : t.vertices(cell))
      if (w == v) return true;
    return false;
  };
  while (!t.is_live(c) || holds(c)) ++c;
  vandal.set_incident(v, c);
  expect("I4");
}

TEST_CASE_FIXTURE(Fixture, "I4: a vertex in no cell") {
  vandal.add_point({0, 0, 0});
  expect("I4");
}

TEST_CASE_FIXTURE(Fixture, "I3: a vertex inside a circumsphere, and one beyond the hull") {
  vandal.add_point({0.01, 0.02, 0.03});
  CHECK(check_delaunay(t).starts_with("I3"));
  vandal.move(SiteId(t.vertex_capacity() - 1), {5, 5, 5});
  CHECK(check_delaunay(t).starts_with("I3"));
}
