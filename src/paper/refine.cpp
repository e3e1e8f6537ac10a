// SPDX-License-Identifier: MIT
#include "paper/refine.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "base/triangle.h"
#include "delaunay/voronoi.h"
#include "mesh/disk.h"
#include "mesh/incidence.h"
#include "paper/recover.h"

namespace deliso::paper {
namespace {

// In r_min: a point nearer to a vertex of E, or of a facet beside it, is not inserted. Two facets
// at one edge can have each other's corner for their x, in turn.
constexpr double kNearRMins = 0.25;

class Refinement {
 public:
  Refinement(SurfaceMesh& t, const Sigma& sigma, const Options& options, Report& report)
      : t_(t), mesh_(t.mesh), sigma_(sigma), options_(options), report_(report) {}

  void refine_geom();

 private:
  const Vec3& at(FaceId f, std::size_t i) const { return mesh_.points[mesh_.faces[f].v[i]]; }
  // 0 up to r_min.
  Violation violation(FaceId f) const;
  SurfaceMesh::Dual dual(FaceId f) {
    return find_dual(at(f, 0), at(f, 1), at(f, 2), sigma_, report_.searches_refine);
  }
  bool is_encroached(FaceId f, const Vec3& p) const {
    constexpr double kInside = 1 - 2e-9;  // by more than rounding
    const Vec3& x = t_.duals[f].x;
    return distance2(x, p) < kInside * distance2(x, at(f, 0));
  }
  // Sets e_ to E, the facets around sigma that p encroaches upon.
  void find_encroached(FaceId sigma, const Vec3& p);
  // Inserts p, x of sigma: D for E. Returns why not.
  std::optional<Refusal> insert(FaceId sigma, const Vec3& p);
  void put_cone(const Vec3& p);

  SurfaceMesh& t_;
  TriMesh& mesh_;
  const Sigma& sigma_;
  const Options& options_;
  Report& report_;
  std::deque<FaceId> queue_;
  std::vector<FaceId> e_, d_;
  Disk disk_, cone_;
};

Violation Refinement::violation(FaceId f) const {
  const FacetShape m = measure(at(f, 0), at(f, 1), at(f, 2), t_.duals[f].x);
  if (m.r <= report_.r_min) return {};
  double pole = 0;
  for (const VertexId v : mesh_.faces[f].v) pole += t_.poles[v] / 3;
  return paper::violation(m, options_.epsilon1, pole, options_);
}

void Refinement::find_encroached(FaceId sigma, const Vec3& p) {
  e_.assign(1, sigma);
  for (std::size_t k = 0; k < e_.size(); ++k) {
    for (const FaceId g : mesh_.faces[e_[k]].n) {
      if (g != kNoId && std::ranges::find(e_, g) == e_.end() && is_encroached(g, p)) {
        e_.push_back(g);
      }
    }
  }
}

std::optional<Refusal> Refinement::insert(FaceId sigma, const Vec3& p) {
  find_encroached(sigma, p);
  if (options_.observer) options_.observer->encroaches(p, e_);
  disk_.facets.clear();
  for (const FaceId f : e_) disk_.facets.push_back(mesh_.faces[f].v);
  if (!disk_.link() || disk_.inner_vertices() > 0) return Refusal::not_a_disk;
  const auto is_near = [&](VertexId v) {
    return distance(p, mesh_.points[v]) < kNearRMins * report_.r_min;
  };
  for (const Disk::BoundaryEdge& edge : disk_.boundary) {
    const FaceId g = mesh_.faces[e_[edge.facet]].n[static_cast<std::size_t>(edge.side)];
    const Vec3 &a = mesh_.points[edge.from], &b = mesh_.points[edge.to];
    if (g == kNoId && dot(a - p, b - p) < 0) return Refusal::at_curve;
    if (is_near(edge.from) || (g != kNoId && std::ranges::any_of(mesh_.faces[g].v, is_near))) {
      return Refusal::vertex_there;
    }
  }
  put_cone(p);
  return std::nullopt;
}

void Refinement::put_cone(const Vec3& p) {
  const VertexId v(mesh_.points.size());
  mesh_.points.push_back(p);
  double poles = 0;
  cone_.facets.clear();
  std::vector<FaceId> outside;
  for (const Disk::BoundaryEdge& edge : disk_.boundary) {
    poles += t_.poles[edge.from];
    cone_.facets.push_back({edge.from, edge.to, v});
    outside.push_back(mesh_.faces[e_[edge.facet]].n[static_cast<std::size_t>(edge.side)]);
  }
  t_.poles.push_back(poles / static_cast<double>(disk_.boundary.size()));
  cone_.link_cone(disk_.boundary, v);
  d_ = e_;  // E's numbers first
  while (d_.size() < cone_.facets.size()) {
    d_.emplace_back(mesh_.faces.size());
    mesh_.faces.emplace_back();
    t_.duals.emplace_back();
  }
  for (std::size_t k = 0; k < d_.size(); ++k) {
    Face& face = mesh_.faces[d_[k]];
    face = {cone_.facets[k], {d_[cone_.across[k][0]], d_[cone_.across[k][1]], outside[k]}};
    if (outside[k] == kNoId) continue;
    neighbor_at_edge_to(mesh_.faces[outside[k]], face.v[0]) = d_[k];
  }
  for (const FaceId f : d_) {
    t_.duals[f] = dual(f);
    queue_.push_back(f);
  }
  ++report_.insertions_refine;
  if (options_.observer) options_.observer->cone_added(v, d_);
}

void Refinement::refine_geom() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) queue_.push_back(f);
  Steps steps(options_.observer);
  while (!queue_.empty()) {
    steps.step(queue_.size());
    const FaceId sigma = queue_.front();
    queue_.pop_front();
    const auto [worst, reason] = violation(sigma);
    if (worst <= 1 || !t_.duals[sigma].on_sigma) continue;
    if (options_.observer) options_.observer->asks(reason, sigma, worst);
    const Vec3 x = t_.duals[sigma].x;
    const std::optional<Refusal> refusal = insert(sigma, x);
    if (refusal) {
      ++(*refusal == Refusal::not_a_disk     ? report_.not_a_disk
         : *refusal == Refusal::vertex_there ? report_.too_near
                                             : report_.curve_refusals);
      if (options_.observer) options_.observer->refused(*refusal);
    } else {
      require_few(mesh_.points.size(), options_);
    }
  }
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    report_.facets_without_point += !t_.duals[f].on_sigma;
    report_.facets_unrefined += violation(f).value > 1;
  }
}

// Reverses facets that are turned against most of their neighbors, of those that may be.
void turn_as_neighbors(std::vector<Triangle>& facets, const std::vector<std::uint8_t>& may,
                       std::size_t vertices) {
  std::vector<std::uint8_t> against(facets.size(), 0);  // edges
  for_each_edge(edge_uses(vertices, facets), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].forward != edge[1].forward) return true;
    for (const EdgeUse& use : edge) ++against[use.triangle];
    return true;
  });
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (may[f] != 0 && against[f] > 1) std::swap(facets[f][1], facets[f][2]);
  }
}

}  // namespace

SurfaceMesh::Dual find_dual(const Vec3& a, const Vec3& b, const Vec3& c, const Sigma& sigma,
                            SearchCounters& counters) {
  const FacetLine line = facet_line(a, b, c);
  const auto hit = sigma.nearest(line.center, line.normal, line.radius, counters);
  return {hit ? hit->point : line.center, hit.has_value()};
}

SurfaceMesh as_mesh(const Triangulation& del, std::vector<Triangle> facets,
                    const std::vector<double>& poles) {
  SurfaceMesh out;
  std::vector<Vec3> points;
  std::vector<VertexId> vertex_of(del.vertex_capacity(), kNoId);  // by site
  for (Triangle& facet : facets) {
    for (VertexId& q : facet) {
      if (vertex_of[q] == kNoId) {
        vertex_of[q] = VertexId(points.size());
        points.push_back(del.point(SiteId(q.number())));
        if (!poles.empty()) out.poles.push_back(poles[q]);
      }
      q = vertex_of[q];
    }
  }
  out.mesh = make_tri_mesh(std::move(points), facets);
  return out;
}

SurfaceMesh build_tri_mesh(const RestrictedDelaunay& del, const std::vector<double>& poles) {
  const Triangulation& t = del.del();
  IdArray<FaceId, SurfaceMesh::Dual> duals;
  std::vector<Triangle> facets;
  std::vector<std::uint8_t> has_several;  // by facet: hits, and so no side that they tell
  for_each_facet(t, [&](Facet sigma) {
    const std::span<const Hit> hits = del.hits(sigma);
    if (hits.empty()) return;
    const SiteTriangle v = facet_vertices(t, sigma);
    const Hit& x = nearest(hits, t.point(v[0]));
    facets.push_back(as_mesh_triangle(turned(v, x)));
    duals.push_back({x.point, true});
    has_several.push_back(hits.size() > 1);
  });
  turn_as_neighbors(facets, has_several, t.vertex_capacity());
  SurfaceMesh out = as_mesh(t, std::move(facets), poles);
  out.duals = std::move(duals);
  return out;
}

void refine_geom(SurfaceMesh& t, const Sigma& sigma, const Options& options, Report& report) {
  Refinement(t, sigma, options, report).refine_geom();
}

}  // namespace deliso::paper
