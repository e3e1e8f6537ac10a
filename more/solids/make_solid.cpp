// SPDX-License-Identifier: MIT
#include "more/solids/make_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/box3.h"
#include "delaunay/triangulation.h"
#include "more/solids/cell_mesh.h"
#include "more/solids/fill.h"
#include "more/solids/improve.h"
#include "more/solids/recover.h"

namespace deliso {
namespace {

// Returns the power of two that brings tiny points to a size at which insphere() does not
// underflow. It changes no bit but those of the exponents.
double scale_of(const IdArray<VertexId, Vec3>& points) {
  constexpr double kTiny = 1e-30;
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return largest > 0 && largest < kTiny ? std::ldexp(1, -std::ilogb(largest)) : 1;
}

// Returns the Delaunay triangulation of the points, and of four more around them, as cells.
CellMesh delaunay_cells(const IdArray<VertexId, Vec3>& given, double scale) {
  IdArray<VertexId, Vec3> points = given;
  for (Vec3& p : points) p = scale * p;
  append_auxiliary(box_of(points), points);
  Triangulation cells;
  std::vector<SiteId> sites;
  if (!cells.build(points, sites)) throw SkinError("its points lie in one plane");
  IdArray<SiteId, VertexId> vertex(cells.vertex_capacity(), kNoId);
  for (VertexId v = 0; v < points.size(); ++v) {
    if (vertex[sites[v]] != kNoId) throw SkinError("two of its points lie at one place");
    vertex[sites[v]] = v;
  }
  return CellMesh(cells, vertex, std::move(points));
}

// Returns the solid of the mesh's cells. Vertices of no cell and no wall are left out, but for the
// first `given`.
Solid solid_of(const CellMesh& mesh, std::vector<Wall> walls, std::size_t given,
               VertexId first_inner) {
  Solid solid;
  solid.walls = std::move(walls);
  std::vector<std::uint8_t> is_used(mesh.points.size(), 0);
  std::fill_n(is_used.begin(), given, 1);
  for (CellId c = 0; c < mesh.cell_capacity(); ++c) {
    if (!mesh.is_live(c)) continue;
    solid.cells.push_back(mesh.corners(c));
    solid.regions.push_back(mesh.region(c));
    for (VertexId v : mesh.corners(c)) is_used[v] = 1;
  }
  for (const Wall& wall : solid.walls) {
    for (VertexId v : wall.v) is_used[v] = 1;
  }
  IdArray<VertexId, VertexId> number(mesh.points.size(), kNoId);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (v == first_inner) solid.skin_points = solid.points.size();
    if (!is_used[v]) continue;
    number[v] = VertexId(solid.points.size());
    solid.points.push_back(mesh.points[v]);
  }
  if (first_inner == mesh.points.size()) solid.skin_points = solid.points.size();
  for (Tetrahedron& cell : solid.cells) {
    for (VertexId& v : cell) v = number[v];
  }
  for (Wall& wall : solid.walls) {
    for (VertexId& v : wall.v) v = number[v];
  }
  return solid;
}

}  // namespace

Solid make_solid(const Skin& skin, const SolidOptions& options) {
  const double scale = scale_of(skin.points);
  CellMesh mesh = delaunay_cells(skin.points, scale);
  std::vector<Wall> walls;
  RecoveryCounts recovery;
  for (int turn = 0; turn == 0 || recovery.lost > 0; ++turn) {
    if (turn == kRecoveryTurns)
      throw SkinError("it crosses itself, or has sheets a rounding apart");
    if (turn > 0) mesh = delaunay_cells(skin.points, scale);
    walls = skin.walls;
    recovery = recover(mesh, walls, turn);
  }
  if (const Wall* wall = set_regions(mesh, walls)) {
    const auto& [a, b, c] = wall->v;
    throw SkinError(
        "it is not closed, or its components do not agree on what is inside; one of them has the "
        "triangle",
        (mesh.points[a] + mesh.points[b] + mesh.points[c]) / (3 * scale));
  }
  const VertexId first_inner(mesh.points.size());
  if (options.fills) {
    CellLocator locator(mesh);
    const auto is_outside = [&](const Vec3& p) {
      const CellId c = locator.cell_at(p);
      return c == kNoId || mesh.region(c) == kOutside;
    };
    const LatticeOptions lattice{options.lattice.growth, scale * options.lattice.max_edge};
    insert_points(mesh, lattice_points(mesh.points, walls, lattice, is_outside));
  }
  mesh.remove_region(kOutside);
  if (options.fills) improve(mesh, first_inner, options.passes);
  Solid solid = solid_of(mesh, std::move(walls), skin.points.size(), first_inner);
  for (Vec3& p : solid.points) p = p / scale;
  solid.recovery = recovery;
  return solid;
}

}  // namespace deliso
