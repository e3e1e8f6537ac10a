// SPDX-License-Identifier: MIT
#include "check/mesh_triangulation.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "check/triangle_lists.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"

namespace deliso {
namespace {

constexpr std::size_t kCellsAtOnce = 1u << 13;

// Counts some of the facets, one after another.
struct FacetCounter {
  VoronoiEdges edges;
  std::vector<Hit> hits;
  SearchCounters searches;

  // `corners` of the facet in the mesh, ascending.
  void operator()(const Triangulation& cells, const Facet& f, const Triangle& corners,
                  const TrianglesByCorners& wanted, const Isosurface& surface) {
    const bool in_mesh = wanted.find(corners) != kNoId;
    edges.delaunay += in_mesh;
    const FacetDual dual = facet_dual(cells, f);
    const Range range =
        clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, surface.volume().box());
    if (range.empty()) return;
    surface.intersect({dual.at(range.lo), dual.at(range.hi)}, hits, searches);
    if (hits.empty()) return;
    ++(in_mesh ? edges.restricted : edges.missing);
    edges.multiple += hits.size() > 1;
  }
};

}  // namespace

VoronoiEdges count_voronoi_edges(const CleanMesh& mesh, const Isosurface& surface, int threads) {
  VoronoiEdges edges;
  if (mesh.triangles.empty()) return edges;
  std::vector<Vec3> points;
  std::vector<VertexId> source;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] == kNoId) continue;
    points.push_back(mesh.points[v]);
    source.push_back(v);
  }
  append_auxiliary(surface.volume().box(), points);
  Triangulation cells;
  std::vector<SiteId> ids;
  edges.measured = cells.build(points, ids, kMaxCellsPerVertex);
  if (!edges.measured) return edges;
  std::vector<VertexId> vertex_of(cells.vertex_capacity(), kNoId);  // of the mesh, per site
  for (std::size_t n = 0; n < source.size(); ++n) vertex_of[ids[n]] = source[n];

  const TrianglesByCorners wanted(mesh.points.size(), mesh.triangles);
  std::vector<FacetCounter> counters(runs_of(cells.cell_capacity(), kCellsAtOnce));
  for_each_run(
      threads, cells.cell_capacity(), kCellsAtOnce,
      [&](std::size_t run, std::size_t begin, std::size_t end) {
        for (auto c = CellId(begin); c < end; ++c) {
          if (!cells.is_live(c) || cells.is_infinite(c)) continue;
          for (int i = 0; i < 4; ++i) {
            if (cells.neighbor(c, i) > c) continue;  // looked at from there
            const Facet f{c, i};
            const SiteTriangle sites = facet_vertices(cells, f);
            Triangle corners{vertex_of[sites[0]], vertex_of[sites[1]], vertex_of[sites[2]]};
            std::ranges::sort(corners);
            if (corners[2] != kNoId) counters[run](cells, f, corners, wanted, surface);
          }
        }
      });
  for (const FacetCounter& counter : counters) {
    edges.delaunay += counter.edges.delaunay;
    edges.restricted += counter.edges.restricted;
    edges.missing += counter.edges.missing;
    edges.multiple += counter.edges.multiple;
  }
  return edges;
}

}  // namespace deliso
