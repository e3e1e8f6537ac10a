// SPDX-License-Identifier: MIT
#include "paper/build_tri_mesh.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/triangle.h"

namespace deliso {
namespace {

// For every facet and corner i, the facet across the edge opposite it, whichever way round the two
// are; kNoId where the edge has not exactly two facets.
std::vector<std::array<FaceId, 3>> undirected_neighbors(std::span<const Triangle> triangles) {
  struct Side {
    VertexId low, high;
    FaceId face;
    int index;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (FaceId f = 0; f < triangles.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = triangles[f][(i + 1) % 3], b = triangles[f][(i + 2) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), f, i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.low, s.high, s.face) < std::tie(t.low, t.high, t.face);
  });
  std::vector<std::array<FaceId, 3>> neighbors(triangles.size(), {kNoId, kNoId, kNoId});
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin != 2) continue;
    const Side &s = sides[begin], &t = sides[begin + 1];
    neighbors[s.face][s.index] = t.face;
    neighbors[t.face][t.index] = s.face;
  }
  return neighbors;
}

// Turns the facets of every component the same way round, by a walk over its adjacency, and the
// whole of it so that most of its area has normals against the gradient: next to a crease of the
// surface a single facet's gradient can mislead.
void orient(const std::vector<Vec3>& points, const std::vector<Dual>& duals,
            const Isosurface& surface, std::span<Triangle> triangles) {
  const auto neighbors = undirected_neighbors(triangles);
  const auto runs_along = [](const Triangle& v, VertexId from, VertexId to) {
    return (v[0] == from && v[1] == to) || (v[1] == from && v[2] == to) ||
           (v[2] == from && v[0] == to);
  };
  std::vector<std::uint8_t> seen(triangles.size(), 0);
  std::vector<FaceId> component;
  for (FaceId start = 0; start < triangles.size(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    component.assign(1, start);
    double along = 0;
    for (std::size_t next = 0; next < component.size(); ++next) {
      const FaceId f = component[next];
      const Triangle v = triangles[f];
      along += dot(area_normal(points[v[0]], points[v[1]], points[v[2]]),
                   surface.gradient(duals[f].center));
      for (const FaceId g : neighbors[f]) {
        if (g == kNoId || seen[g]) continue;
        seen[g] = 1;
        component.push_back(g);
        for (int i = 0; i < 3; ++i) {
          if (!runs_along(triangles[g], v[i], v[(i + 1) % 3])) continue;
          std::swap(triangles[g][0], triangles[g][1]);
          break;
        }
      }
    }
    if (along <= 0) continue;
    for (const FaceId f : component) std::swap(triangles[f][0], triangles[f][1]);
  }
}

}  // namespace

SurfaceMesh build_tri_mesh(RestrictedDelaunay&& handed_over, const SiteChain& chain,
                           const std::vector<double>& poles) {
  const RestrictedDelaunay restricted = std::move(handed_over);
  const Triangulation& t = restricted.triangulation();
  std::vector<VertexId> new_id(t.vertex_capacity(), kNoId);
  SurfaceMesh out;
  std::vector<Triangle> triangles;
  for (RecordId r = 0; r < restricted.record_capacity(); ++r) {
    if (!restricted.is_live(r) || !restricted.is_restricted(r)) continue;
    const SiteTriangle v = restricted.triangle(r);
    out.duals.push_back(
        dual_at(t.point(v[0]), t.point(v[1]), t.point(v[2]), restricted.surface_point(r)));
    for (const SiteId q : v) {
      if (new_id[q] != kNoId) continue;
      new_id[q] = VertexId(out.mesh.points.size());
      out.mesh.points.push_back(t.point(q));
      if (!poles.empty()) out.pole_heights.push_back(poles[q]);
    }
    triangles.push_back({new_id[v[0]], new_id[v[1]], new_id[v[2]]});
  }
  orient(out.mesh.points, out.duals, restricted.surface(), triangles);
  out.mesh = make_tri_mesh(std::move(out.mesh.points), triangles);
  out.chain = chain.renumbered(new_id);
  return out;
}

}  // namespace deliso
