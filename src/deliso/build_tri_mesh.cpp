// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/triangle.h"
#include "deliso/recovered.h"

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
void orient(const std::vector<Vec3>& points, const std::vector<Vec3>& surface_points,
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
                   surface.gradient(surface_points[f]));
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

// Where the surface is cut by an edge of the box at a sharp angle, the tip of the wedge can be too
// thin for a Voronoi edge to tell its two sides apart: the chain's vertex there has no facet, and
// the chain's neighbours are joined past it. The tip's triangle is put back.
void close_tips(const Triangulation& t, const BoundaryChain& chain, std::vector<VertexId>& new_id,
                std::vector<Triangle>& triangles, Report& report, Recovered& out) {
  const auto neighbors = undirected_neighbors(triangles);
  std::vector<std::pair<VertexId, VertexId>> open;  // edges of one facet, smaller vertex first
  for (FaceId f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (neighbors[f][i] != kNoId) continue;
      const VertexId a = triangles[f][(i + 1) % 3], b = triangles[f][(i + 2) % 3];
      open.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(open.begin(), open.end());
  for (VertexId tip = 1; tip < t.vertex_capacity(); ++tip) {
    if (!chain.is_boundary(tip) || new_id[tip] != kNoId) continue;
    const VertexId a = new_id[chain.previous(tip)], b = new_id[chain.next(tip)];
    if (a == kNoId || b == kNoId) continue;
    if (!std::binary_search(open.begin(), open.end(), std::pair(std::min(a, b), std::max(a, b)))) {
      continue;
    }
    new_id[tip] = static_cast<VertexId>(out.mesh.points.size());
    out.mesh.points.push_back(t.point(tip));
    out.pole_heights.push_back(0.5 * (out.pole_heights[a] + out.pole_heights[b]));
    out.source.push_back(tip);
    triangles.push_back({a, new_id[tip], b});
    out.mesh.surface_points.push_back(t.point(tip));
    ++report[Counter::tips_closed];
  }
}

}  // namespace

Recovered build_tri_mesh(RestrictedDelaunay&& handed_over, const BoundaryChain& chain,
                         const std::vector<double>& poles) {
  const RestrictedDelaunay restricted = std::move(handed_over);
  const Triangulation& t = restricted.triangulation();

  struct Corner {
    Triangle v;
    Vec3 x;
  };
  std::vector<Corner> facets;
  for (RecordId r = 0; r < restricted.record_capacity(); ++r) {
    if (!restricted.is_live(r) || !restricted.is_restricted(r)) continue;
    facets.push_back({restricted.triangle(r), restricted.surface_point(r)});
  }

  std::vector<VertexId> new_id(t.vertex_capacity(), kNoId);
  Recovered out;
  std::vector<Triangle> triangles;
  for (const Corner& facet : facets) {
    Triangle v = facet.v;
    for (VertexId& q : v) {
      if (new_id[q] == kNoId) {
        new_id[q] = static_cast<VertexId>(out.mesh.points.size());
        out.mesh.points.push_back(t.point(q));
        out.pole_heights.push_back(poles[q]);
        out.source.push_back(q);
      }
      q = new_id[q];
    }
    triangles.push_back(v);
    out.mesh.surface_points.push_back(facet.x);
  }
  close_tips(t, chain, new_id, triangles, restricted.report(), out);
  orient(out.mesh.points, out.mesh.surface_points, restricted.surface(), triangles);
  std::vector<Vec3> surface_points = std::move(out.mesh.surface_points);
  out.mesh = make_tri_mesh(std::move(out.mesh.points), triangles);
  out.mesh.surface_points = std::move(surface_points);
  out.chain = chain.renumbered(new_id);
  return out;
}

}  // namespace deliso
