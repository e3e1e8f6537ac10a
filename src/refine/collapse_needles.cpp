// SPDX-License-Identifier: MIT
#include "refine/collapse_needles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "base/triangle.h"
#include "refine/crossing_guard.h"
#include "surface/surface_point.h"
#include "mesh/collapse.h"

namespace deliso {
namespace {

// The least cosine between a facet's normals before and after.
constexpr double kLeastCosine = 0.7;

// How much worse the worst triangle there may become: where three vertices are close to each other,
// the first of two collapses leaves a needle as bad as the one it takes.
constexpr double kWorse = 2;

double ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  return distance(circumcenter(a, b, c), a) / std::sqrt(shortest_edge2(a, b, c));
}

class NeedleCollapser {
 public:
  NeedleCollapser(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
                  const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
                  Report& report)
      : mesh_(recovered.mesh),
        unhit_(recovered.unhit),
        chain_(recovered.chain),
        box_(surface.volume().box()),
        finder_(surface),
        guard_(surface.volume(), recovered.mesh, guarded_voxels, 2 * criteria.r_min),
        curves_(curves),
        criteria_(criteria),
        report_(report) {}

  // Goes on while edges can be collapsed; whether there were any.
  bool run();

 private:
  struct Edge {
    double length2;
    FaceId f;
    int i;
  };
  std::vector<Edge> short_edges() const;
  bool collapse(FaceId f, int i, VertexId from);
  // Whether the chain can do without v.
  bool may_go(VertexId v) const {
    return !chain_.is_boundary(v) || !curves_.is_corner(chain_.place(v));
  }
  bool joins_on_box(VertexId v, VertexId w) const;
  // Whether a facet that the planned collapse changes comes to cross another.
  bool would_cross() const;

  TriMesh& mesh_;
  std::vector<std::uint8_t>& unhit_;
  BoundaryChain& chain_;
  const Box3 box_;
  SurfacePointFinder finder_;
  CrossingGuard guard_;
  const BoundaryCurves& curves_;
  const Criteria criteria_;
  Report& report_;
  Collapse plan_;
  struct SurfacePoint {
    FaceId facet;
    Vec3 x;
    bool unhit;
  };
  std::vector<SurfacePoint> surface_points_;
};

std::vector<NeedleCollapser::Edge> NeedleCollapser::short_edges() const {
  const double limit = criteria_.r_min / criteria_.lambda;
  std::vector<Edge> edges;
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    const Face& face = mesh_.faces[f];
    for (int i = 0; !is_dead(face) && i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      if (!chain_.is_boundary(a) && !chain_.is_boundary(b)) continue;
      const double length2 = distance2(mesh_.points[a], mesh_.points[b]);
      if (length2 < limit * limit) edges.push_back({length2, f, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& s, const Edge& t) {
    return std::tie(s.length2, s.f, s.i) < std::tie(t.length2, t.f, t.i);
  });
  return edges;
}

// Whether v and w would be joined within a face of the box by an edge that is not of its boundary.
bool NeedleCollapser::joins_on_box(VertexId v, VertexId w) const {
  if (!chain_.is_boundary(v) || !chain_.is_boundary(w) || chain_.is_edge(v, w)) return false;
  const Vec3 &p = mesh_.points[v], &q = mesh_.points[w];
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == q[axis] && (p[axis] == box_.lo[axis] || p[axis] == box_.hi[axis])) return true;
  }
  return false;
}

bool NeedleCollapser::would_cross() const {
  std::vector<Triangle> changed;
  for (const SurfacePoint& point : surface_points_) {
    changed.push_back(mesh_.faces[point.facet].v);
    std::replace(changed.back().begin(), changed.back().end(), plan_.from, plan_.to);
  }
  return guard_.would_cross(changed, plan_.star);
}

bool NeedleCollapser::collapse(FaceId f, int i, VertexId from) {
  if (!may_go(from) || !plan_collapse(mesh_, f, i, from, plan_)) return false;
  const VertexId to = plan_.to;
  if (chain_.is_boundary(from) && chain_.next(chain_.next(chain_.next(from))) == from) {
    return false;  // a loop of three
  }
  double worst_before = 0, worst_after = 0;
  surface_points_.clear();
  for (const FaceId g : plan_.star) {
    const Triangle& v = mesh_.faces[g].v;
    const Vec3 &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
    worst_before = std::max(worst_before, ratio(a, b, c));
    if (std::find(v.begin(), v.end(), to) != v.end()) continue;
    std::array<Vec3, 3> p{a, b, c};
    for (int k = 0; k < 3; ++k) {
      if (v[k] == from) {
        p[k] = mesh_.points[to];
      } else if (!chain_.is_boundary(from) && joins_on_box(to, v[k])) {
        return false;
      }
    }
    const Vec3 before = area_normal(a, b, c), after = area_normal(p[0], p[1], p[2]);
    if (!(dot(before, after) > kLeastCosine * length(before) * length(after))) return false;
    worst_after = std::max(worst_after, ratio(p[0], p[1], p[2]));
    const auto x = finder_.find(p[0], p[1], p[2], report_.searches_refine);
    // Facets that Stage 2 does not look at only need a ball; near the box its center may lie
    // outside.
    const Vec3 center = circumcenter(p[0], p[1], p[2]);
    if (!x && distance(center, p[0]) > criteria_.r_min) return false;
    surface_points_.push_back({g, x ? *x : center, !x});
  }
  if (worst_before <= criteria_.lambda || worst_after > kWorse * worst_before) return false;
  if (guard_.is_on() && would_cross()) return false;
  collapse_edge(mesh_, plan_);
  for (const SurfacePoint& point : surface_points_) {
    mesh_.surface_points[point.facet] = point.x;
    unhit_[point.facet] = point.unhit;
    if (guard_.is_on()) guard_.add(point.facet);
  }
  if (chain_.is_boundary(from)) chain_.remove(from);
  ++report_[Counter::needles_collapsed];
  return true;
}

bool NeedleCollapser::run() {
  bool any = false, again = true;
  while (again) {
    again = false;
    for (const Edge& edge : short_edges()) {
      const Face& face = mesh_.faces[edge.f];
      if (is_dead(face)) continue;
      const VertexId a = face.v[(edge.i + 1) % 3], b = face.v[(edge.i + 2) % 3];
      // Ends may have changed since.
      if (distance2(mesh_.points[a], mesh_.points[b]) != edge.length2) continue;
      // Of a boundary edge the end that the chain can do without, of others the inner end.
      again |= collapse(edge.f, edge.i, chain_.is_boundary(a) ? b : a) ||
               collapse(edge.f, edge.i, chain_.is_boundary(a) ? a : b);
    }
    any |= again;
  }
  return any;
}

}  // namespace

void collapse_needles(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
                      const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
                      Report& report) {
  if (!NeedleCollapser(recovered, surface, curves, criteria, guarded_voxels, report).run()) return;
  recovered.source.resize(recovered.mesh.points.size(), kNoId);  // Stage 2 gives none
  std::size_t live = 0;
  for (FaceId f = 0; f < recovered.mesh.faces.size(); ++f) {
    if (!is_dead(recovered.mesh.faces[f])) recovered.unhit[live++] = recovered.unhit[f];
  }
  recovered.unhit.resize(live);
  std::vector<VertexId> new_id;
  remove_dead(recovered.mesh, new_id);
  recovered.chain = recovered.chain.renumbered(new_id);
  for (VertexId v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == kNoId) continue;
    recovered.pole_heights[new_id[v]] = recovered.pole_heights[v];
    recovered.source[new_id[v]] = recovered.source[v];
  }
  recovered.pole_heights.resize(recovered.mesh.points.size());
  recovered.source.resize(recovered.mesh.points.size());
}

}  // namespace deliso
