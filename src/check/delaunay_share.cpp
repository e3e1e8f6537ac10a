// SPDX-License-Identifier: MIT
#include "check/delaunay_share.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "delaunay/voronoi.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A triangle by its sorted corners, from the mesh or as a facet of the triangulation.
struct Key {
  Triangle corners;
  std::uint32_t item;
};

void sort_by_corners(std::vector<Key>& keys) {
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.corners, a.item) < std::tie(b.corners, b.item);
  });
}

// The corners of a regular tetrahedron about the box, 16 of its diagonals away.
void add_auxiliary(const Box3& box, std::vector<Vec3>& points) {
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  const double d = 16 * length(box.size());
  for (const Vec3& to : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    points.push_back(middle + d * to);
  }
}

struct Crossing {
  double t = kInfinity;  // of the point of Sigma on a dual line nearest to the circumcenter
};

Crossing nearest_crossing(const FacetLine& line, const Isosurface& surface,
                          SearchCounters& counters) {
  const auto hit = surface.nearest(line.center, line.normal, kBallLimit * line.radius, counters);
  return hit ? Crossing{hit->t} : Crossing{};
}

FacetLine line_of(const CleanMesh& mesh, const Triangle& t) {
  return facet_line(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

}  // namespace

DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const Isosurface& surface) {
  DelaunayShare share;
  share.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return share;

  const Box3 box = surface.volume().box();
  std::vector<Vec3> points;
  std::vector<VertexId> source;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] == kNoId) continue;
    points.push_back(mesh.points[v]);
    source.push_back(v);
  }
  add_auxiliary(box, points);
  Triangulation t;
  std::vector<VertexId> ids;
  if (!t.build(points, ids)) return share;
  std::vector<VertexId> vertex_of(t.vertex_capacity(), kNoId);  // of the mesh
  for (std::size_t n = 0; n < source.size(); ++n) vertex_of[ids[n]] = source[n];

  std::vector<Key> wanted;
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    Triangle corners = mesh.triangles[n];
    std::sort(corners.begin(), corners.end());
    wanted.push_back({corners, n});
  }
  sort_by_corners(wanted);
  enum : std::uint8_t { kNoFacet, kFacet, kRestricted };
  std::vector<std::uint8_t> state(mesh.triangles.size(), kNoFacet);

  SearchCounters counters;
  std::vector<Hit> hits;
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    for (int i = 0; i < 4; ++i) {
      const Facet f{c, i};
      if (t.neighbor(c, i) < c || has_infinite_vertex(t, f)) continue;  // once, from the larger id
      Triangle corners = facet_vertices(t, f);
      for (VertexId& v : corners) v = vertex_of[v];
      std::sort(corners.begin(), corners.end());
      if (corners[2] == kNoId) continue;  // an auxiliary vertex
      const FacetDual dual = facet_dual(t, f);
      const Range range = clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, box);
      std::size_t crossings = 0;
      if (!range.empty()) {
        surface.intersect({dual.at(range.lo), dual.at(range.hi)}, hits, counters);
        crossings = hits.size();
      }
      share.multiple += crossings > 1;
      const auto found = std::lower_bound(
          wanted.begin(), wanted.end(), corners,
          [](const Key& key, const Triangle& sought) { return key.corners < sought; });
      if (found == wanted.end() || found->corners != corners) {
        share.missing += crossings > 0;
        continue;
      }
      state[found->item] = crossings > 0 ? kRestricted : kFacet;
    }
  }

  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    share.delaunay += state[n] != kNoFacet;
    share.restricted += state[n] == kRestricted;
    if (state[n] == kRestricted) continue;
    if (share.first_outside.size() < Faults::kShown) share.first_outside.push_back(mesh.id[n]);
    // A surface ball is empty exactly when its center is on the dual Voronoi edge.
    const bool ball =
        std::isfinite(nearest_crossing(line_of(mesh, mesh.triangles[n]), surface, counters).t);
    share.occupied += ball;
    share.without_ball += !ball;
  }
  return share;
}

std::vector<double> surface_heights(const CleanMesh& mesh, const Isosurface& surface) {
  std::vector<double> heights;
  SearchCounters counters;
  for (const Triangle& t : mesh.triangles) {
    heights.push_back(std::fabs(nearest_crossing(line_of(mesh, t), surface, counters).t));
  }
  return heights;
}

}  // namespace deliso
