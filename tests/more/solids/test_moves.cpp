// SPDX-License-Identifier: MIT
// CellMesh and its moves, on Delaunay triangulations of a few random points: what may not be done
// is refused and changes nothing; the best triangulation of a ring is the best of all of them.
#include "more/solids/moves.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "base/random.h"
#include "cases.h"
#include "delaunay/triangulation.h"
#include "exact/predicates.h"
#include "more/solids/quality.h"

using namespace deliso;
using namespace deliso::test;

namespace {

CellMesh random_cells(std::uint64_t seed, int points) {
  Random random(seed);
  IdArray<VertexId, Vec3> p;
  for (int n = 0; n < points; ++n) {
    // Every other time near an axis, which has many cells around it.
    const double width = seed % 2 == 0 && n > 3 ? .2 : 1;
    p.push_back(
        {width * random.uniform(-1, 1), width * random.uniform(-1, 1), random.uniform(-1, 1)});
  }
  Triangulation cells;
  std::vector<SiteId> sites;
  REQUIRE(cells.build(p, sites));
  IdArray<SiteId, VertexId> vertex(cells.vertex_capacity(), kNoId);
  for (VertexId v = 0; v < p.size(); ++v) vertex[sites[v]] = v;
  return CellMesh(cells, vertex, p);
}

// The cells by their sorted corners, and the walls.
using State = std::multiset<std::vector<std::uint32_t>>;
State state_of(const CellMesh& mesh) {
  State state;
  for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
    if (!mesh.is_live(c)) continue;
    std::vector<std::uint32_t> v(mesh.corners(c).begin(), mesh.corners(c).end());
    std::ranges::sort(v);
    state.insert(v);
    for (int i = 0; i < 4; ++i) {
      if (!mesh.is_wall({c, i})) continue;
      std::vector<std::uint32_t> wall;
      for (const int k : kFacetVertices[i]) wall.push_back(mesh.corners(c)[k]);
      std::ranges::sort(wall);
      state.insert(wall);
    }
  }
  return state;
}

// S1, and neighbors are mutual: the facets that they name have the same corners.
void check_mesh(const CellMesh& mesh) {
  std::size_t wrong = 0;
  for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
    if (!mesh.is_live(c)) continue;
    const Tetrahedron& v = mesh.corners(c);
    const auto& p = mesh.points;
    wrong += orient3d(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) <= 0;
    for (int i = 0; i < 4; ++i) {
      const Facet g = mesh.mirror({c, i});
      if (g.cell == kNoId) continue;
      wrong += !mesh.is_live(g.cell) || mesh.mirror(g) != Facet{c, i};
      wrong += mesh.is_wall(g) != mesh.is_wall({c, i});
      for (const int k : kFacetVertices[i]) wrong += !has_corner(mesh.corners(g.cell), v[k]);
    }
    for (const VertexId w : v) wrong += !has_corner(mesh.corners(mesh.incident_cell(w)), w);
  }
  CHECK(wrong == 0);
}

// Calls use(triangles) for all triangulations of the polygon i ... k.
using Triangles3 = std::vector<std::array<int, 3>>;
void for_each_triangulation(int i, int k, Triangles3& done,
                            const std::function<void(Triangles3&)>& use) {
  if (k - i < 2) return use(done);
  for (int j = i + 1; j < k; ++j) {
    done.push_back({i, j, k});
    for_each_triangulation(i, j, done,
                           [&](Triangles3& left) { for_each_triangulation(j, k, left, use); });
    done.pop_back();
  }
}

// Returns the largest least shape over all triangulations of the ring, of the cells over and under
// each triangle. `may_join`: of diagonals.
double best_by_trying(const CellMesh& mesh, const Ring& ring, const MayJoin& may_join) {
  double best = -1;
  const int n = static_cast<int>(ring.v.size());
  Triangles3 none;
  for_each_triangulation(0, n - 1, none, [&](Triangles3& triangles) {
    double least = 2;
    for (const auto& [i, j, k] : triangles) {
      for (const auto& [from, to] : {std::pair{i, j}, {j, k}, {i, k}}) {
        const bool is_side = to - from == 1 || to - from == n - 1;
        if (!is_side && may_join && !may_join(ring.v[from], ring.v[to])) least = -1;
      }
      least = std::min({least, shape(mesh, {ring.v[i], ring.v[j], ring.v[k], ring.b}),
                        shape(mesh, {ring.v[k], ring.v[j], ring.v[i], ring.a})});
    }
    best = std::max(best, least);
  });
  return best;
}

}  // namespace

TEST_CASE("an edge is removed by the best triangulation of its ring, or not at all") {
  int removed = 0, refused = 0, forbidden = 0;
  std::set<std::size_t> sizes;
  for (std::uint64_t seed = 1; seed <= cases(3000u); ++seed) {
    CAPTURE(seed);
    CellMesh mesh = random_cells(seed, 8 + static_cast<int>(seed % 5));
    Random random(seed);
    for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
      if (!mesh.is_live(c)) continue;
      Ring ring;
      const Tetrahedron v = mesh.corners(c);
      const std::uint32_t i = random.below(4), k = (i + 1 + random.below(3)) % 4;
      find_ring(mesh, c, v[i], v[k], ring);
      if (!ring.is_closed || ring.v.size() > 8) continue;
      CHECK(ring.v.size() == ring.cells.size());
      const std::uint32_t kept_apart = random.below(3);
      const MayJoin may_join = [&](VertexId a, VertexId b) { return (a + b) % 3 != kept_apart; };
      const bool asks = seed % 2 == 0;
      const double best = best_by_trying(mesh, ring, asks ? may_join : MayJoin{});
      if (asks) forbidden += best < best_by_trying(mesh, ring, {});
      const double floor = random.below(2) * .1;
      const State before = state_of(mesh);
      const bool is_done = remove_edge(mesh, ring, floor, asks ? may_join : MayJoin{});
      CHECK(is_done == (best > floor));
      check_mesh(mesh);
      if (!is_done) {
        CHECK(state_of(mesh) == before);
        ++refused;
        continue;
      }
      ++removed;
      sizes.insert(ring.v.size());
      CHECK(mesh.cell_with(v[i], v[k]) == kNoId);
      CHECK(mesh.last_created().size() == 2 * (ring.v.size() - 2));
      CHECK(least_shape(mesh, mesh.last_created()) == best);
    }
  }
  CHECK(removed > static_cast<int>(cases(1000u)));
  CHECK(refused > static_cast<int>(cases(1000u)));
  CHECK(forbidden > static_cast<int>(cases(100u)));
  CHECK(sizes.size() >= 3);
}

TEST_CASE("a facet is removed if its three new cells are positive, and put back by its edge") {
  int removed = 0;
  for (std::uint64_t seed = 1; seed <= cases(500u); ++seed) {
    CAPTURE(seed);
    CellMesh mesh = random_cells(seed, 9);
    const State before = state_of(mesh);
    for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
      for (int i = 0; i < 4 && mesh.is_live(c); ++i) {
        const Facet f{c, i};
        const Facet g = mesh.mirror(f);
        if (g.cell == kNoId) {
          CHECK_FALSE(remove_facet(mesh, f, 0));
          continue;
        }
        const VertexId top = mesh.corners(c)[i], bottom = mesh.corners(g.cell)[g.index];
        if (!remove_facet(mesh, f, 0)) {
          CHECK(state_of(mesh) == before);
          continue;
        }
        ++removed;
        check_mesh(mesh);
        Ring ring;
        find_ring(mesh, mesh.cell_with(top, bottom), top, bottom, ring);
        CHECK(ring.v.size() == 3);
        CHECK(remove_edge(mesh, ring, 0));
        CHECK(state_of(mesh) == before);
      }
    }
  }
  CHECK(removed > static_cast<int>(cases(500u)));
}

TEST_CASE("walls stay: no edge at one, no facet that is one, no ball with one inside") {
  int walls = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= cases(200u); ++seed) {
    CAPTURE(seed);
    CellMesh mesh = random_cells(seed, 9);
    for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
      const Facet f{c, static_cast<int>(seed % 4)};
      if (mesh.mirror(f).cell == kNoId) continue;
      const CellMesh free = mesh;
      mesh.set_wall(f);
      ++walls;
      CHECK(mesh.is_wall(mesh.mirror(f)));
      const State before = state_of(mesh);
      CHECK_FALSE(remove_facet(mesh, f, 0));
      const auto& at = kFacetVertices[f.index];
      for (int k = 0; k < 3; ++k) {
        Ring ring;
        const Tetrahedron& v = mesh.corners(c);
        find_ring(mesh, c, v[at[k]], v[at[(k + 1) % 3]], ring);
        CHECK(ring.has_wall);
        CellMesh copy = free;
        held += remove_edge(copy, ring, 0);
        CHECK_FALSE(remove_edge(mesh, ring, 0));
        CHECK(state_of(mesh) == before);
      }
      break;
    }
  }
  CHECK(walls == static_cast<int>(cases(200u)));
  CHECK(held > 0);
}

TEST_CASE("a ball is replaced over its own boundary only") {
  for (std::uint64_t seed = 1; seed <= cases(200u); ++seed) {
    CAPTURE(seed);
    CellMesh mesh = random_cells(seed, 10);
    const State before = state_of(mesh);
    std::vector<CellId> gone{0};
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbor(0, i) != kNoId) gone.push_back(mesh.neighbor(0, i));
    }
    std::vector<Tetrahedron> cells;
    for (const CellId c : gone) cells.push_back(mesh.corners(c));
    // One cell less, one twice, one with another corner; all of another ball.
    std::vector<Tetrahedron> wrong(cells.begin() + 1, cells.end());
    CHECK_FALSE(mesh.replace_ball(gone, wrong));
    wrong = cells;
    wrong.push_back(cells[0]);
    CHECK_FALSE(mesh.replace_ball(gone, wrong));
    wrong = cells;
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      if (!has_corner(cells.back(), v)) wrong.back()[0] = v;
    }
    CHECK_FALSE(mesh.replace_ball(gone, wrong));
    CHECK_FALSE(mesh.replace_ball(gone, {}));
    CHECK(state_of(mesh) == before);
    check_mesh(mesh);
    CHECK(mesh.replace_ball(gone, cells));
    CHECK(state_of(mesh) == before);
    check_mesh(mesh);
  }
}

TEST_CASE("a star from a new point fills a cell, keeps its walls, or leaves all as it was") {
  for (std::uint64_t seed = 1; seed <= cases(200u); ++seed) {
    CAPTURE(seed);
    CellMesh mesh = random_cells(seed, 9);
    for (int i = 0; i < 4; ++i) mesh.set_wall({0, i});
    mesh.set_region(0, 5);
    const State before = state_of(mesh);
    const std::size_t points = mesh.points.size();
    const Tetrahedron v = mesh.corners(0);
    const std::array<CellId, 1> zone{0};
    const Vec3 middle =
        .25 * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]] + mesh.points[v[3]]);
    CHECK(star_from(mesh, mesh.points[v[0]], zone, 0) == kNoId);
    CHECK(star_from(mesh, middle, zone, 1) == kNoId);
    CHECK(state_of(mesh) == before);
    CHECK(mesh.points.size() == points);
    const VertexId x = star_from(mesh, middle, zone, 0);
    REQUIRE(x == points);
    check_mesh(mesh);
    int walls = 0;
    for (const CellId c : mesh.last_created()) {
      CHECK(mesh.region(c) == 5);
      walls += mesh.is_wall({c, corner_index(mesh.corners(c), x)});
    }
    CHECK(mesh.last_created().size() == 4);
    CHECK(walls == 4);
    std::vector<CellId> star;
    mesh.cells_at(x, star);
    CHECK(star.size() == 4);
  }
}

TEST_CASE("the shape is the least sine of the dihedral angles") {
  const double r = std::sqrt(.5);
  CHECK(shape({1, 0, -r}, {-1, 0, -r}, {0, -1, r}, {0, 1, r}) * 3 ==
        doctest::Approx(2 * std::sqrt(2.)));
  CHECK(shape({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == doctest::Approx(std::sqrt(2. / 3)));
  CHECK(shape({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}) == -1);
  CHECK(shape({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}) == -1);
  // A flat angle, which has a small sine too.
  CHECK(shape({0, 0, 0}, {2, 0, 0}, {1, .01, 1}, {1, .02, -1}) < .05);
}

TEST_CASE("the shape is the least sine of the six dihedral angles") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::array<Vec3, 4> p;
    for (Vec3& corner : p) corner = {random.uniform(), random.uniform(), .2 * random.uniform()};
    if (orient3d(p[0], p[1], p[2], p[3]) < 0) std::swap(p[2], p[3]);
    double least = 1;
    for (int i = 0; i < 4; ++i) {
      for (int k = i + 1; k < 4; ++k) {
        // The other two corners, seen along the edge.
        const Vec3 axis = p[k] - p[i];
        std::array<Vec3, 2> beside;
        for (int n = 0, c = 0; n < 4; ++n) {
          if (n == i || n == k) continue;
          const Vec3 to = p[n] - p[i];
          beside[c++] = to - dot(to, axis) / length2(axis) * axis;
        }
        const double cosine = cosine_between(beside[0], beside[1]);
        least = std::min(least, std::sqrt(1 - cosine * cosine));
      }
    }
    CHECK(shape(p[0], p[1], p[2], p[3]) == doctest::Approx(least).epsilon(1e-6));
    CHECK(shape(p[1], p[0], p[2], p[3]) < 0);
  }
}
