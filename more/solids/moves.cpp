// SPDX-License-Identifier: MIT
#include "more/solids/moves.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "more/solids/quality.h"

namespace deliso {
namespace {

// True if (0, 1, 2, 3) -> (i, j, k, l) is an even permutation.
constexpr bool is_even(int i, int j, int k, int l) {
  return ((i > j) + (i > k) + (i > l) + (j > k) + (j > l) + (k > l)) % 2 == 0;
}

// The other two corners of a cell at the edge a b: (a, b, first, second) is positively oriented.
std::array<int, 2> others(const Tetrahedron& v, VertexId a, VertexId b) {
  const int i = corner_index(v, a), j = corner_index(v, b);
  std::array<int, 2> other{};
  for (int k = 0, n = 0; k < 4; ++k) {
    if (k != i && k != j) other[n++] = k;
  }
  if (!is_even(i, j, other[0], other[1])) std::swap(other[0], other[1]);
  return other;
}

}  // namespace

void find_ring(const CellMesh& mesh, CellId first, VertexId a, VertexId b, Ring& ring) {
  ring = {a, b, std::move(ring.v), std::move(ring.cells)};
  ring.v.clear();
  ring.cells.clear();
  // Back to the border, if there is one, or once around.
  CellId start = first;
  while (true) {
    const auto [u, w] = others(mesh.corners(start), a, b);
    const CellId before = mesh.neighbor(start, w);
    if (before == kNoId || before == first) {
      ring.is_closed = before != kNoId;
      break;
    }
    start = before;
  }
  if (ring.is_closed) start = first;
  for (CellId c = start;;) {
    const auto [u, w] = others(mesh.corners(c), a, b);
    ring.v.push_back(mesh.corners(c)[u]);
    ring.cells.push_back(c);
    ring.has_wall |= mesh.is_wall({c, u}) || mesh.is_wall({c, w});
    const CellId next = mesh.neighbor(c, u);
    if (next == kNoId) ring.v.push_back(mesh.corners(c)[w]);
    if (next == kNoId || next == start) return;
    c = next;
  }
}

double least_shape(const CellMesh& mesh, std::span<const CellId> cells) {
  double least = std::numeric_limits<double>::infinity();
  for (CellId c : cells) least = std::min(least, shape(mesh, mesh.corners(c)));
  return least;
}

bool remove_edge(CellMesh& mesh, const Ring& ring, double floor, const MayJoin& may_join) {
  const int n = static_cast<int>(ring.v.size());
  if (!ring.is_closed || n < 3 || n > static_cast<int>(kMostAround)) return false;
  // best[i][k]: of the polygon i ... k, its least shape; via[i][k]: the third corner at its edge.
  std::array<std::array<double, kMostAround>, kMostAround> best;
  std::array<std::array<int, kMostAround>, kMostAround> via;
  const auto cells_of = [&](int i, int j, int k) {
    return std::array<Tetrahedron, 2>{
        {{ring.v[i], ring.v[j], ring.v[k], ring.b}, {ring.v[k], ring.v[j], ring.v[i], ring.a}}};
  };
  for (int i = 0; i + 1 < n; ++i) best[i][i + 1] = std::numeric_limits<double>::infinity();
  for (int sides = 2; sides < n; ++sides) {
    for (int i = 0; i + sides < n; ++i) {
      const int k = i + sides;
      best[i][k] = -1;
      if (sides < n - 1 && may_join && !may_join(ring.v[i], ring.v[k])) continue;
      for (int j = i + 1; j < k; ++j) {
        double least = std::min(best[i][j], best[j][k]);
        for (const Tetrahedron& v : cells_of(i, j, k)) {
          if (least > std::max(floor, best[i][k])) least = std::min(least, shape(mesh, v));
        }
        if (least > std::max(floor, best[i][k])) best[i][k] = least, via[i][k] = j;
      }
    }
  }
  if (best[0][n - 1] <= floor) return false;
  std::vector<Tetrahedron> created;
  std::vector<std::pair<int, int>> polygons{{0, n - 1}};
  while (!polygons.empty()) {
    const auto [i, k] = polygons.back();
    polygons.pop_back();
    if (k - i < 2) continue;
    const int j = via[i][k];
    for (const Tetrahedron& v : cells_of(i, j, k)) created.push_back(v);
    polygons.emplace_back(i, j);
    polygons.emplace_back(j, k);
  }
  return mesh.replace_ball(ring.cells, created);
}

bool remove_facet(CellMesh& mesh, Facet f, double floor) {
  const Facet g = mesh.mirror(f);
  if (g.cell == kNoId || mesh.is_wall(f)) return false;
  const Tetrahedron& v = mesh.corners(f.cell);
  const VertexId top = v[f.index], bottom = mesh.corners(g.cell)[g.index];
  std::array<Tetrahedron, 3> created;
  for (int i = 0; i < 3; ++i) {
    const auto& corner = kFacetVertices[f.index];
    created[i] = {top, v[corner[i]], v[corner[(i + 1) % 3]], bottom};
    if (shape(mesh, created[i]) <= floor) return false;
  }
  const std::array<CellId, 2> gone{f.cell, g.cell};
  return mesh.replace_ball(gone, created);
}

VertexId star_from(CellMesh& mesh, const Vec3& p, std::span<const CellId> zone, double floor) {
  const VertexId x = mesh.add_point(p);
  std::vector<Tetrahedron> created;
  bool is_good = true;
  for (CellId c : zone) {
    for (int i = 0; i < 4 && is_good; ++i) {
      const CellId n = mesh.neighbor(c, i);
      if (std::ranges::find(zone, n) != zone.end()) continue;
      created.push_back(mesh.corners(c));
      created.back()[i] = x;
      is_good = shape(mesh, created.back()) > floor;
    }
  }
  if (is_good && mesh.replace_ball(zone, created)) return x;
  mesh.drop_point();
  return kNoId;
}

}  // namespace deliso
