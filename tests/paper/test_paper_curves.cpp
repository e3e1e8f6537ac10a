// SPDX-License-Identifier: MIT
// Marching Squares on the faces of the box, against every square by itself.
#include "paper/boundary_curves.h"

#include <doctest/doctest.h>

#include <bit>
#include <set>

#include "contour/contour.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::BoundaryCurves;
using paper::marching_squares;

namespace {

// A grid edge by its lower sample and its axis.
using GridEdge = std::array<int, 4>;

GridEdge grid_edge(Index3 a, Index3 b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis]) {
      const Index3& low = a[axis] < b[axis] ? a : b;
      return {low.i, low.j, low.k, axis};
    }
  }
  return {};
}

// The grid edge that a point lies within: one of its coordinates is between two samples.
GridEdge grid_edge_of(const Volume& volume, const Vec3& p) {
  GridEdge edge{};
  for (int axis = 0; axis < 3; ++axis) {
    const double u = volume.in_samples(p, axis);
    edge[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(u));
    if (u != std::floor(u)) edge[3] = axis;
  }
  return edge;
}

struct Piece {
  int face;
  GridEdge a, b;
  Piece(int on, const GridEdge& p, const GridEdge& q)
      : face(on), a(std::min(p, q)), b(std::max(p, q)) {}
  auto operator<=>(const Piece&) const = default;
};

// Where four grid edges are crossed, the corners on one side are joined exactly if the saddle of
// the bilinear interpolant is on that side too.
std::set<Piece> pieces_by_saddles(const Volume& volume, double kappa, int& saddles) {
  std::set<Piece> pieces;
  const Index3 dims = volume.dims();
  for_each_index(dims, [&](int i, int j, int k) {
    const Index3 low{i, j, k};
    for (int face = 0; face < 6; ++face) {
      const int w = face / 2, u = w == 0 ? 1 : 0, v = w == 2 ? 1 : 2;
      if (low[w] != (face % 2 == 0 ? 0 : dims[w] - 1)) continue;
      if (low[u] + 1 == dims[u] || low[v] + 1 == dims[v]) continue;
      const auto corner = [&](int du, int dv) {
        Index3 c = low;
        c[u] += du;
        c[v] += dv;
        return c;
      };
      const auto inside = [&](Index3 c) { return volume.sample(c.i, c.j, c.k) >= kappa; };
      const std::array<Index3, 4> around{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
      // The two crossed edges at each corner that is on its own side.
      std::vector<GridEdge> crossed;
      for (std::size_t m = 0; m < 4; ++m) {
        if (inside(around[m]) != inside(around[(m + 1) % 4])) {
          crossed.push_back(grid_edge(around[m], around[(m + 1) % 4]));
        }
      }
      if (crossed.size() == 2) pieces.emplace(face, crossed[0], crossed[1]);
      if (crossed.size() != 4) continue;
      ++saddles;
      const auto value = [&](int m) {
        const Index3& c = around[static_cast<std::size_t>(m)];
        return volume.sample(c.i, c.j, c.k);
      };
      const double twist = value(0) - value(1) + value(2) - value(3);
      Vec3 saddle = volume.position(low);
      saddle[u] += (value(0) - value(3)) / twist * volume.spacing()[u];
      saddle[v] += (value(0) - value(1)) / twist * volume.spacing()[v];
      const bool saddle_inside = volume.value(saddle) >= kappa;
      for (std::size_t m = 0; m < 4; ++m) {
        if (inside(around[m]) == saddle_inside) continue;
        pieces.emplace(face, grid_edge(around[(m + 3) % 4], around[m]),
                       grid_edge(around[m], around[(m + 1) % 4]));
      }
    }
  });
  return pieces;
}

// Closed curves, of edges by the numbers of their points.
std::size_t count_loops(const BoundaryCurves& curves) {
  std::vector<std::uint32_t> loop(curves.points.size());
  for (std::uint32_t n = 0; n < loop.size(); ++n) loop[n] = n;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b, face] : curves.edges) {
      const std::uint32_t low = std::min(loop[a], loop[b]);
      changed |= loop[a] != low || loop[b] != low;
      loop[a] = loop[b] = low;
    }
  }
  return std::set(loop.begin(), loop.end()).size();
}

}  // namespace

TEST_CASE("the curves of each square are those of its bilinear saddle") {
  int saddles = 0, turns = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Volume volume = sampled<float>(
        {5, 6, 7}, {1, 1.5, 0.5},
        [random = Random(seed)](int, int, int) mutable { return random.uniform(-1, 1); });
    const double kappa = geometric_isovalue(volume.type(), 0.1);
    const BoundaryCurves curves = marching_squares(volume, kappa);
    std::set<Piece> pieces;
    for (const auto& [a, b, face] : curves.edges) {
      pieces.emplace(face, grid_edge_of(volume, curves.points[a]),
                     grid_edge_of(volume, curves.points[b]));
    }
    CHECK(pieces.size() == curves.edges.size());
    CHECK(pieces == pieces_by_saddles(volume, kappa, saddles));
    std::vector<int> edges_at(curves.points.size(), 0);
    for (const auto& [a, b, face] : curves.edges) {
      ++edges_at[a];
      ++edges_at[b];
    }
    for (std::size_t n = 0; n < curves.points.size(); ++n) {
      CHECK(edges_at[n] == 2);
      CHECK(std::fabs(volume.value(curves.points[n]) - kappa) < 1e-12);
      turns += std::popcount(box_faces_at(curves.points[n], volume.box())) == 2;
    }
    CHECK(count_loops(curves) == build_contour(volume, kappa).summary.boundary_loops());
  }
  CHECK(saddles > 200);
  CHECK(turns > 200);
}

TEST_CASE("a saddle exactly at the isovalue counts as inside, as in the contour") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    // The lower face alternates, its saddle is 0; the upper one is on one side.
    const Volume volume = sampled<double>({2, 2, 2}, {1, 1, 1}, [&](int i, int j, int k) {
      return k == 0 ? (i == j ? sign : -sign) : -2.0;
    });
    const BoundaryCurves curves = marching_squares(volume, 0);
    CHECK(count_loops(curves) == 1);
    CHECK(count_loops(curves) == build_contour(volume, 0).summary.boundary_loops());
  }
}

TEST_CASE("a sample at the isovalue is inside") {
  for (const double others : {1.0, -1.0}) {
    CAPTURE(others);
    const Volume volume = sampled<double>(
        {3, 3, 3}, {1, 1, 1}, [&](int i, int j, int k) { return i + j + k == 0 ? 0 : others; });
    // Three squares meet at the corner; each cuts it off where it alone is inside.
    CHECK(marching_squares(volume, 0).edges.size() == (others < 0 ? 3 : 0));
  }
}
