// SPDX-License-Identifier: MIT
// The checkers must find every broken rule: break one at a time.
#include "delaunay/check_triangulation.h"

#include <doctest/doctest.h>

#include <algorithm>
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
};

struct Damage {
  const char* rule;  // that the checker must find broken
  void (*make)(Fixture&);
};
constexpr Damage kDamages[] = {
    // A link to a wrong facet; a missing cell; a vertex twice in a cell.
    {"I1",
     [](Fixture& f) {
       f.vandal.relink(f.finite, 2, f.t.mirror({f.finite, 1}));
     }},
    {"I1", [](Fixture& f) { f.vandal.remove(f.finite); }},
    {"I1", [](Fixture& f) { f.vandal.set_vertex(f.finite, 2, f.t.vertex(f.finite, 3)); }},
    // A finite cell of negative orientation, and one at infinity.
    {"I2", [](Fixture& f) { f.turn_over(f.finite, 0, 1); }},
    {"I2", [](Fixture& f) { f.turn_over(f.infinite, 1, 2); }},
    // The infinite vertex is not the first.
    {"I5", [](Fixture& f) { f.turn_over(f.infinite, 0, 1); }},
    // An incident cell that does not hold its vertex; a vertex in no cell.
    {"I4",
     [](Fixture& f) {
       const SiteId v = f.t.vertex(f.finite, f.t.vertex(f.finite, 0) == 0 ? 1 : 0);
       CellId c = 0;
       const auto holds = [&](CellId cell) {
         return std::ranges::count(f.t.vertices(cell), v) > 0;
       };
       while (!f.t.is_live(c) || holds(c)) ++c;
       f.vandal.set_incident(v, c);
     }},
    {"I4", [](Fixture& f) {
       f.vandal.add_point({0, 0, 0});
     }}};

}  // namespace

TEST_CASE("each broken rule of a triangulation is found") {
  for (const Damage& damage : kDamages) {
    Fixture f;
    damage.make(f);
    const std::string found = check_triangulation(f.t);
    CHECK_MESSAGE(found.starts_with(damage.rule), found);
  }
}

TEST_CASE_FIXTURE(Fixture, "I3: a vertex inside a circumsphere, and one beyond the hull") {
  vandal.add_point({0.01, 0.02, 0.03});
  CHECK(check_delaunay(t).starts_with("I3"));
  vandal.move(SiteId(t.vertex_capacity() - 1), {5, 5, 5});
  CHECK(check_delaunay(t).starts_with("I3"));
}
