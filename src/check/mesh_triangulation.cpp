// SPDX-License-Identifier: MIT
#include "check/mesh_triangulation.h"

#include <algorithm>

#include "base/parallel.h"
#include "delaunay/voronoi.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

constexpr std::size_t kCellsAtOnce = 1u << 13;

}  // namespace

MeshTriangulation::MeshTriangulation(const CleanMesh& mesh, const Box3& box) {
  std::vector<Vec3> points;
  std::vector<VertexId> source;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] == kNoId) continue;
    points.push_back(mesh.points[v]);
    source.push_back(v);
  }
  append_auxiliary(box, points);
  std::vector<SiteId> ids;
  built_ = cells_.build(points, ids, kMaxCellsPerVertex);
  if (!built_) return;
  vertex_of_.assign(cells_.vertex_capacity(), kNoId);
  for (std::size_t n = 0; n < source.size(); ++n) vertex_of_[ids[n]] = source[n];
}

Triangle MeshTriangulation::corners(const Facet& f) const {
  const SiteTriangle sites = facet_vertices(cells_, f);
  Triangle corners{vertex_of_[sites[0]], vertex_of_[sites[1]], vertex_of_[sites[2]]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

VoronoiEdges count_voronoi_edges(const CleanMesh& mesh, const MeshTriangulation& triangulation,
                                 const Isosurface& surface, const FreeSpace& free, int threads) {
  VoronoiEdges edges;
  edges.measured = mesh.triangles.empty() || triangulation.built();
  if (mesh.triangles.empty() || !edges.measured) return edges;

  const Triangulation& cells = triangulation.cells();
  const Box3 box = surface.volume().box();
  IdArray<CellId, FreeSpace::Cube> cubes(cells.cell_capacity());
  for_each_run(threads, cubes.size(), kCellsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (auto c = CellId(begin); c < end; ++c) {
      if (!cells.is_live(c) || cells.is_infinite(c)) continue;
      const Circumsphere sphere = circumsphere(cells, c);
      cubes[c] = free.around(sphere.center, sphere.radius);
    }
  });
  const TrianglesByCorners wanted(mesh.points.size(), mesh.triangles);
  enum : std::uint8_t { kNoFacet, kFacet, kRestricted };
  std::vector<std::uint8_t> state(mesh.triangles.size(), kNoFacet);
  // Calls visit(facet, run) for the facets whose corners are all of the mesh; each once, from the
  // cell with the larger id.
  const auto for_each_facet = [&](auto&& visit) {
    for_each_run(threads, cells.cell_capacity(), kCellsAtOnce,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   for (auto c = CellId(begin); c < end; ++c) {
                     if (!cells.is_live(c) || cells.is_infinite(c)) continue;
                     for (int i = 0; i < 4; ++i) {
                       if (cells.neighbor(c, i) < c) visit(Facet{c, i}, run);
                     }
                   }
                 });
  };
  struct Run {  // of facets
    std::size_t missing = 0, multiple = 0;
    std::vector<Hit> hits;
    SearchCounters counters;
  };
  std::vector<Run> runs(runs_of(cells.cell_capacity(), kCellsAtOnce));
  for_each_facet([&](const Facet& f, std::size_t n) {
    if (cover_segment(cubes[f.cell], cubes[cells.neighbor(f.cell, f.index)])) return;
    const Triangle corners = triangulation.corners(f);
    if (corners[2] == kNoId) return;
    const FacetDual dual = facet_dual(cells, f);
    const Range range = clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, box);
    if (range.empty()) return;
    Run& run = runs[n];
    surface.intersect({dual.at(range.lo), dual.at(range.hi)}, run.hits, run.counters);
    const std::size_t crossings = run.hits.size();
    if (crossings == 0) return;
    run.multiple += crossings > 1;
    const std::uint32_t found = wanted.find(corners);
    if (found == kNoId) {
      ++run.missing;
    } else {
      state[found] = kRestricted;
    }
  });
  for (const Run& run : runs) {
    edges.missing += run.missing;
    edges.multiple += run.multiple;
  }
  // The few other triangles may still be Delaunay facets.
  std::vector<std::uint8_t> is_corner(mesh.points.size(), 0);
  for (std::size_t n = 0; n < state.size(); ++n) {
    for (const VertexId v : mesh.triangles[n]) is_corner[v] |= state[n] == kNoFacet;
  }
  for_each_facet([&](const Facet& f, std::size_t) {
    for (const SiteId site : facet_vertices(cells, f)) {
      const VertexId v = triangulation.vertex(site);
      if (v == kNoId || !is_corner[v]) return;
    }
    const std::uint32_t found = wanted.find(triangulation.corners(f));
    if (found != kNoId && state[found] == kNoFacet) state[found] = kFacet;
  });

  for (const std::uint8_t kind : state) {
    edges.delaunay += kind != kNoFacet;
    edges.restricted += kind == kRestricted;
  }
  return edges;
}

}  // namespace deliso
