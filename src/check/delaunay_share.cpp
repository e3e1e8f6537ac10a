// SPDX-License-Identifier: MIT
#include "check/delaunay_share.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "delaunay/voronoi.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

constexpr std::size_t kCellsAtOnce = 1u << 13, kFacetsAtOnce = 1u << 11;

// Appends the corners of a regular tetrahedron around the box, 16 of its diagonals away.
void add_auxiliary(const Box3& box, std::vector<Vec3>& points) {
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  const double d = 16 * length(box.size());
  for (const Vec3& to : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    points.push_back(middle + d * to);
  }
}

// Returns the parameter of the point of Sigma on a dual line nearest to the circumcenter; infinity
// without one.
double nearest_crossing(const FacetLine& line, const Isosurface& surface,
                        SearchCounters& counters) {
  const auto hit =
      surface.nearest(line.center, line.normal, kBallLimitRadii * line.radius, counters);
  return hit ? hit->t : std::numeric_limits<double>::infinity();
}

FacetLine line_of(const CleanMesh& mesh, const Triangle& t) {
  return facet_line(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

// The Delaunay triangulation of a mesh's vertices.
class MeshTriangulation {
 public:
  // Returns false if there is none: all points in one plane with the auxiliary vertices, or given
  // up.
  bool build(const CleanMesh& mesh, const Box3& box) {
    std::vector<Vec3> points;
    std::vector<VertexId> source;
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      if (mesh.component[v] == kNoId) continue;
      points.push_back(mesh.points[v]);
      source.push_back(v);
    }
    add_auxiliary(box, points);
    std::vector<SiteId> ids;
    if (!cells_.build(points, ids, kMaxCellsPerVertex)) return false;
    vertex_of_.assign(cells_.vertex_capacity(), kNoId);
    for (std::size_t n = 0; n < source.size(); ++n) vertex_of_[ids[n]] = source[n];
    return true;
  }

  const Triangulation& cells() const { return cells_; }
  // Returns the facet's corners, ascending, with kNoId for auxiliary vertices.
  Triangle corners(const Facet& f) const {
    const SiteTriangle sites = facet_vertices(cells_, f);
    Triangle corners{vertex_of_[sites[0]], vertex_of_[sites[1]], vertex_of_[sites[2]]};
    std::sort(corners.begin(), corners.end());
    return corners;
  }

 private:
  Triangulation cells_;
  std::vector<VertexId> vertex_of_;  // of the mesh
};

// Counts over the Voronoi edges of the facets of some cells.
struct EdgeCounts {
  std::size_t missing = 0, multiple = 0;
};

}  // namespace

DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const Isosurface& surface,
                                     int threads) {
  DelaunayShare share;
  share.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return share;
  const Box3 box = surface.volume().box();
  MeshTriangulation t;
  share.measured = t.build(mesh, box);
  if (!share.measured) return share;

  const TrianglesByCorners wanted(mesh.points.size(), mesh.triangles);
  enum : std::uint8_t { kNoFacet, kFacet, kRestricted };
  std::vector<std::uint8_t> state(mesh.triangles.size(), kNoFacet);
  const std::size_t cells = t.cells().cell_capacity();
  std::vector<EdgeCounts> counts(runs_of(cells, kCellsAtOnce));
  for_each_run(
      threads, cells, kCellsAtOnce, [&](std::size_t run, std::size_t begin, std::size_t end) {
        SearchCounters counters;
        std::vector<Hit> hits;
        for (auto c = CellId(begin); c < end; ++c) {
          if (!t.cells().is_live(c)) continue;
          for (int i = 0; i < 4; ++i) {
            const Facet f{c, i};
            // Each facet once, from the cell with the larger id.
            if (t.cells().neighbor(c, i) < c || has_infinite_vertex(t.cells(), f)) continue;
            const Triangle corners = t.corners(f);
            if (corners[2] == kNoId) continue;
            const FacetDual dual = facet_dual(t.cells(), f);
            const Range range = clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, box);
            std::size_t crossings = 0;
            if (!range.empty()) {
              surface.intersect({dual.at(range.lo), dual.at(range.hi)}, hits, counters);
              crossings = hits.size();
            }
            counts[run].multiple += crossings > 1;
            const std::uint32_t found = wanted.find(corners);
            if (found == kNoId) {
              counts[run].missing += crossings > 0;
            } else {
              state[found] = crossings > 0 ? kRestricted : kFacet;
            }
          }
        }
      });
  for (const EdgeCounts& c : counts) {
    share.missing += c.missing;
    share.multiple += c.multiple;
  }

  SearchCounters counters;
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    share.delaunay += state[n] != kNoFacet;
    share.restricted += state[n] == kRestricted;
    if (state[n] == kRestricted) continue;
    if (share.first_outside.size() < Faults::kShown) share.first_outside.push_back(mesh.id[n]);
    // A surface ball is empty exactly if its center is on the dual Voronoi edge.
    const bool ball =
        std::isfinite(nearest_crossing(line_of(mesh, mesh.triangles[n]), surface, counters));
    share.occupied += ball;
    share.without_ball += !ball;
  }
  return share;
}

std::vector<double> surface_heights(const CleanMesh& mesh, const Isosurface& surface, int threads) {
  std::vector<double> heights(mesh.triangles.size());
  for_each_run(threads, heights.size(), kFacetsAtOnce, [&](std::size_t begin, std::size_t end) {
    SearchCounters counters;
    for (std::size_t n = begin; n < end; ++n) {
      heights[n] = std::fabs(nearest_crossing(line_of(mesh, mesh.triangles[n]), surface, counters));
    }
  });
  return heights;
}

}  // namespace deliso
