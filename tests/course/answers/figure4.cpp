// SPDX-License-Identifier: MIT
// An answer to the last exercise of the course.
#include "course/figure4.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"
#include "delaunay/voronoi.h"
#include "mesh/disk.h"
#include "mesh/star.h"
#include "paper/boundary_curves.h"
#include "paper/intersect.h"
#include "paper/poles.h"

namespace deliso::course {
namespace {

using paper::Options;

SiteTriangle sorted_corners(const Triangulation& del, Facet f) {
  SiteTriangle v = facet_vertices(del, f);
  std::ranges::sort(v);
  return v;
}

class DelIso {
 public:
  DelIso(const Volume& volume, double kappa, const Options& options)
      : tree_(volume),
        sigma_(tree_, kappa, options.solver),
        options_(options),
        box_(volume.box()),
        r_min_(options.r_min * box_.smallest_side()) {}

  void init_triangulation();
  void recover();
  void build_tri_mesh();
  void refine_geom();
  TriMesh mesh() { return std::move(mesh_); }

 private:
  struct Restricted {
    std::vector<Hit> hits;
    CellId cell;
  };

  Vec3 somewhere(Random& random) const {
    const double x = random.uniform(box_.lo.x, box_.hi.x), y = random.uniform(box_.lo.y, box_.hi.y);
    return {x, y, random.uniform(box_.lo.z, box_.hi.z)};
  }
  void search(Facet f);
  bool is_beside_curve(const Vec3& p, const Vec3& a, const Vec3& b) const {
    return dot(a - p, b - p) < 0;
  }
  bool insert(const Vec3& p, CellId hint);
  template <class Ask>
  void sweep(Ask&& ask);
  void extract_manifold();
  FacetShape shape(const SiteTriangle& v, const Vec3& x) const {
    return measure(del_.point(v[0]), del_.point(v[1]), del_.point(v[2]), x);
  }

  const Vec3& at(FaceId f, std::size_t i) const { return mesh_.points[mesh_.faces[f].v[i]]; }
  void find_x(FaceId f);
  bool is_bad(FaceId f) const;
  void insert_in_mesh(FaceId sigma);

  VoxelTree tree_;
  paper::Sigma sigma_;
  Options options_;
  Box3 box_;
  double r_min_;
  SearchCounters counters_;

  Triangulation del_;
  std::map<SiteTriangle, Restricted> facets_;  // Del S|Sigma, by sorted corners
  std::set<SiteId> on_curve_;
  std::vector<std::pair<Vec3, Vec3>> curve_edges_;

  TriMesh mesh_;
  IdArray<FaceId, std::optional<Vec3>> x_;
  IdArray<VertexId, double> poles_;
  std::deque<FaceId> queue_;
};

void DelIso::init_triangulation() {
  const paper::BoundaryCurves curves = paper::marching_squares(sigma_.volume(), sigma_.kappa());
  std::vector<Vec3> sample = curves.points;
  for (const auto& e : curves.edges) curve_edges_.emplace_back(sample[e.a], sample[e.b]);
  Random random(options_.seed);
  for (std::size_t n = 0; n < options_.lines; ++n) {
    const Vec3 a = somewhere(random), b = somewhere(random);
    const Vec3 along = (length(box_.size()) / distance(a, b)) * (b - a);
    for (const Hit& x : sigma_.intersect({a - along, a + along}, counters_)) {
      sample.push_back(x.point);
    }
  }
  append_auxiliary(box_, sample);
  std::vector<SiteId> ids;
  del_.build(sample, ids);
  for (std::size_t n = 0; n < curves.points.size(); ++n) on_curve_.insert(ids[n]);
  for_each_facet(del_, [&](Facet f) { search(f); });
}

void DelIso::search(Facet f) {
  if (has_infinite_vertex(del_, f)) return;
  const FacetDual edge = facet_dual(del_, f);
  const Range t = clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, box_);
  if (!(t.lo < t.hi)) return;
  std::vector<Hit> hits;
  for (const Hit& x : sigma_.intersect({edge.at(t.lo), edge.at(t.hi)}, counters_)) {
    if (!hits.empty() && distance(hits.back().point, x.point) < Options::kClosest * r_min_) {
      hits.pop_back();
    } else {
      hits.push_back(x);
    }
  }
  if (!hits.empty()) facets_[sorted_corners(del_, f)] = {hits, f.cell};
}

bool DelIso::insert(const Vec3& p, CellId hint) {
  ConflictZone zone;
  del_.find_conflicts(p, hint, zone);
  if (zone.duplicate != kNoId) return false;
  for (const auto& [a, b] : curve_edges_) {
    if (is_beside_curve(p, a, b)) return false;
  }
  for (const CellId c : zone.cells) {
    for (int i = 0; i < 4; ++i) facets_.erase(sorted_corners(del_, {c, i}));
  }
  std::vector<CellId> created;
  del_.insert_in_zone(p, zone, created);
  for (const CellId c : created) {
    for (int i = 0; i < 4; ++i) search({c, i});
  }
  return true;
}

// Inserts the point that `ask` has for a facet of Del S|Sigma, until it has none.
template <class Ask>
void DelIso::sweep(Ask&& ask) {
  for (bool grows = true; grows;) {
    grows = false;
    std::vector<SiteTriangle> all;
    for (const auto& facet : facets_) all.push_back(facet.first);
    for (const SiteTriangle& v : all) {
      const auto facet = facets_.find(v);
      if (facet == facets_.end()) continue;
      const std::optional<Vec3> p = ask(v, facet->second.hits);
      if (p) grows |= insert(*p, facet->second.cell);
    }
  }
}

void DelIso::extract_manifold() {
  for (bool grows = true; grows;) {
    grows = false;
    for (SiteId q = 1; q < del_.vertex_capacity(); ++q) {
      const Vec3 at = del_.point(q);
      std::vector<Triangle> d_q;
      Vec3 furthest = at;
      CellId cell = kNoId;
      for (const auto& [v, facet] : facets_) {
        if (!has_corner(v, q)) continue;
        d_q.push_back(as_mesh_triangle(v));
        for (const Hit& x : facet.hits) {
          if (distance(x.point, at) < distance(furthest, at)) continue;
          furthest = x.point;
          cell = facet.cell;
        }
      }
      const Star star = classify_star(VertexId(q.number()), d_q);
      if (star == Star::disk || star == Star::empty) continue;
      if (star == Star::half_disk && on_curve_.contains(q)) continue;
      grows |= insert(furthest, cell);
    }
  }
}

void DelIso::recover() {
  sweep([&](const SiteTriangle& v, const std::vector<Hit>& hits) -> std::optional<Vec3> {
    if (hits.size() < 2) return {};
    return std::ranges::max_element(
               hits, {}, [&](const Hit& x) { return distance(x.point, del_.point(v[0])); })
        ->point;
  });
  extract_manifold();
  sweep([&](const SiteTriangle& v, const std::vector<Hit>& hits) -> std::optional<Vec3> {
    const Vec3 x = hits[0].point;
    const FacetShape m = shape(v, x);
    if (m.r <= r_min_ || (m.h <= options_.epsilon * m.r && m.r <= options_.lambda * m.l)) return {};
    return x;
  });
  extract_manifold();
}

void DelIso::build_tri_mesh() {
  const std::vector<double> heights = paper::compute_poles(del_, sigma_);
  std::map<SiteId, VertexId> vertex_of;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (const auto& [v, facet] : facets_) {
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [known, is_new] = vertex_of.try_emplace(v[i], VertexId(points.size()));
      corners[i] = known->second;
      if (!is_new) continue;
      points.push_back(del_.point(v[i]));
      poles_.push_back(heights[v[i]]);
    }
    // The Voronoi edge sees sorted corners turn counter-clockwise, and leaves the inside there.
    if (!facet.hits[0].leaves) std::swap(corners[1], corners[2]);
    triangles.push_back(corners);
    x_.push_back(facet.hits[0].point);
  }
  mesh_ = make_tri_mesh(std::move(points), triangles);
  mesh_.frame = sigma_.volume().frame();
}

void DelIso::find_x(FaceId f) {
  const FacetLine line = facet_line(at(f, 0), at(f, 1), at(f, 2));
  const auto hit = sigma_.nearest(line.center, line.normal, line.radius, counters_);
  x_[f] = hit ? std::optional(hit->point) : std::nullopt;
}

bool DelIso::is_bad(FaceId f) const {
  if (!x_[f]) return false;
  const FacetShape m = measure(at(f, 0), at(f, 1), at(f, 2), *x_[f]);
  double height = 0;
  for (const VertexId v : mesh_.faces[f].v) height += poles_[v] / 3;
  return m.r > r_min_ && (m.h > options_.epsilon1 * m.r || m.r > options_.epsilon2 * height ||
                          m.r > options_.lambda * m.l);
}

void DelIso::insert_in_mesh(FaceId sigma) {
  const Vec3 p = *x_[sigma];
  std::vector<FaceId> e{sigma};
  Disk disk, cone;
  for (std::size_t k = 0; k < e.size(); ++k) {
    disk.facets.push_back(mesh_.faces[e[k]].v);
    for (const FaceId g : mesh_.faces[e[k]].n) {
      if (g == kNoId || !x_[g] || std::ranges::count(e, g) > 0) continue;
      if (distance(*x_[g], p) < (1 - 1e-9) * distance(*x_[g], at(g, 0))) e.push_back(g);
    }
  }
  if (!disk.link() || disk.inner_vertices() > 0) return;
  const VertexId v(mesh_.points.size());
  std::vector<FaceId> outside;
  double height = 0;
  for (const Disk::BoundaryEdge& edge : disk.boundary) {
    const Vec3 &a = mesh_.points[edge.from], &b = mesh_.points[edge.to];
    const FaceId g = mesh_.faces[e[edge.facet]].n[static_cast<std::size_t>(edge.side)];
    if (distance(p, a) < 0.25 * r_min_ || (g == kNoId && is_beside_curve(p, a, b))) return;
    cone.facets.push_back({edge.from, edge.to, v});
    outside.push_back(g);
    height += poles_[edge.from];
  }
  cone.link_cone(disk.boundary, v);
  mesh_.points.push_back(p);
  poles_.push_back(height / static_cast<double>(cone.facets.size()));
  while (e.size() < cone.facets.size()) {
    e.emplace_back(mesh_.faces.size());
    mesh_.faces.emplace_back();
    x_.emplace_back();
  }
  for (std::size_t k = 0; k < e.size(); ++k) {
    mesh_.faces[e[k]] = {cone.facets[k], {e[cone.across[k][0]], e[cone.across[k][1]], outside[k]}};
    if (outside[k] != kNoId) {
      neighbor_at_edge_to(mesh_.faces[outside[k]], cone.facets[k][0]) = e[k];
    }
    find_x(e[k]);
    queue_.push_back(e[k]);
  }
}

void DelIso::refine_geom() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) queue_.push_back(f);
  while (!queue_.empty()) {
    const FaceId f = queue_.front();
    queue_.pop_front();
    if (is_bad(f)) insert_in_mesh(f);
  }
}

}  // namespace

TriMesh figure4(const Volume& volume, double kappa, const Options& options) {
  DelIso run(volume, kappa, options);
  run.init_triangulation();
  run.recover();
  run.build_tri_mesh();
  if (!options.stop_after_recover) run.refine_geom();
  return run.mesh();
}

}  // namespace deliso::course
