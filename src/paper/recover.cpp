// SPDX-License-Identifier: MIT
#include "paper/recover.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/sorted_list.h"
#include "base/stopwatch.h"
#include "paper/orient.h"
#include "stage1/build_tri_mesh.h"
#include "stage1/poles.h"
#include "surface/criteria.h"

namespace deliso {
namespace {

// Smallest surface ball whose center is inserted, in r_min. Without a limit, sheets of pure noise
// that are arbitrarily close would be refined forever.
constexpr double kMinBallRMins = 0.01;

// A hit is real if its ball, shrunk by this factor, holds no vertex. The factor covers rounding.
constexpr double kBallTolerance = 0.999;

// Shortest boundary edge that is split, in voxels. Two curves very close to each other encroach
// upon each other however short their edges are.
constexpr double kShortestEdgeVoxels = 0.02;

}  // namespace

Recovery::Recovery(const Isosurface& surface, const BoundaryCurves& curves, FirstSample first,
                   const Parameters& parameters, Report& report)
    : curves_(curves),
      parameters_(parameters),
      follower_(follower(parameters.observer)),
      steps_(parameters.observer),
      report_(report),
      restricted_(surface, std::move(first.triangulation), parameters.r_min, report, follower_),
      chain_(std::move(first.chain)),
      min_ball_(kMinBallRMins * parameters.r_min),
      shortest_edge_(std::max(kShortestBoundaryEdge * parameters.r_min,
                              kShortestEdgeVoxels * parameters.voxel)) {
  for (SiteId v = 1; v < restricted_.triangulation().vertex_capacity(); ++v) {
    if (!restricted_.is_auxiliary(v)) queue_vertex(v);
  }
}

void Recovery::recover() {
  begin("topology");
  protect_boundary();
  multi_intersect();
  extract_manifold();
  if (!std::isfinite(parameters_.recovery[Criterion::h_over_r])) return;
  begin("geometry");
  std::vector<double> no_poles;
  approximate_geom(parameters_.recovery, no_poles);
  extract_manifold();
}

void Recovery::queue_vertex(SiteId v) {
  if (v >= vertex_queued_.size()) vertex_queued_.resize(v + 1, 0);
  if (vertex_queued_[v]) return;
  vertex_queued_[v] = 1;
  vertex_queue_.push_back(v);
}

void Recovery::after_insertion() {
  for (const SiteId v : restricted_.touched()) queue_vertex(v);
  created_.insert(created_.end(), restricted_.created().begin(), restricted_.created().end());
  require_room(restricted_.triangulation(), parameters_);
}

std::vector<SiteId> Recovery::boundary_vertices(const ConflictZone& zone) const {
  std::vector<SiteId> found;
  for (const CellId c : zone.cells) {
    for (const SiteId v : restricted_.triangulation().vertices(c)) {
      if (chain_.is_boundary(v)) found.push_back(v);
    }
  }
  sort_unique(found);
  return found;
}

std::vector<SiteId> Recovery::encroached_edges(const Vec3& p, std::span<const SiteId> near) const {
  const Triangulation& t = restricted_.triangulation();
  std::vector<SiteId> edges;
  for (const SiteId v : near) {
    for (const SiteId a : {v, chain_.previous(v)}) {
      if (in_diametral_ball(t.point(a), t.point(chain_.next(a)), p)) edges.push_back(a);
    }
  }
  return edges;
}

Attempt Recovery::insert(RecordId r, const Vec3& x) {
  created_.clear();
  const Attempt attempt = try_insert(r, x);
  if (follower_) follower_->attempt_ended(attempt, x);
  return attempt;
}

Attempt Recovery::try_insert(RecordId r, const Vec3& x) {
  const Triangulation& t = restricted_.triangulation();
  const double radius = distance(x, t.point(restricted_.triangle(r)[0]));
  if (radius < min_ball_) {
    ++report_[Counter::capped_insertions];
    return Attempt::refused;
  }
  const ConflictZone& zone = restricted_.prepare(x, restricted_.facet(r).cell);
  if (zone.duplicate != kNoId || restricted_.distance_to_vertices(x) < kBallTolerance * radius) {
    for (const SiteId v : restricted_.triangle(r)) queue_vertex(v);
    restricted_.forget(r);
    return Attempt::forgotten;
  }
  const std::vector<SiteId> edges = encroached_edges(x, boundary_vertices(zone));
  if (!edges.empty()) {
    // The longest; of equal ones the smallest id.
    const SiteId edge = *std::ranges::max_element(edges, {}, [&](SiteId a) {
      return std::pair(distance2(t.point(a), t.point(chain_.next(a))), ~a.number());
    });
    return split_edge(edge) ? Attempt::split : Attempt::refused;
  }
  restricted_.insert_prepared(x);
  after_insertion();
  return Attempt::inserted;
}

bool Recovery::split_edge(SiteId a) {
  const Triangulation& t = restricted_.triangulation();
  bool any = false;
  std::vector<SiteId> pending{a};
  while (!pending.empty()) {
    const SiteId from = pending.back(), to = chain_.next(from);
    pending.pop_back();
    const Vec3 pa = t.point(from), pb = t.point(to);
    if (any && !is_encroached(from)) continue;
    const auto middle = distance(pa, pb) < shortest_edge_
                            ? std::nullopt
                            : curves_.split({chain_.place(from), pa}, {chain_.place(to), pb});
    if (!middle) {
      ++report_[Counter::refused_splits];
      continue;
    }
    const ConflictZone& zone = restricted_.prepare(middle->point, t.incident_cell(from));
    if (zone.duplicate != kNoId) {
      ++report_[Counter::refused_splits];
      continue;
    }
    const std::vector<SiteId> near = boundary_vertices(zone);
    if (follower_) follower_->edge_split(from, to);
    const SiteId v = restricted_.insert_prepared(middle->point);
    chain_.insert_after(from, v, middle->place);
    queue_vertex(from);
    queue_vertex(to);
    after_insertion();
    ++report_[Counter::boundary_splits_recover];
    any = true;
    // The balls of both halves may hold older vertices; the balls of near edges may hold the new
    // one.
    const std::vector<SiteId> encroached = encroached_edges(middle->point, near);
    pending.insert(pending.end(), encroached.begin(), encroached.end());
    pending.insert(pending.end(), {v, from});
  }
  return any;
}

bool Recovery::is_encroached(SiteId a) {
  const Triangulation& t = restricted_.triangulation();
  const SiteId b = chain_.next(a);
  // The ball of an edge holds a vertex iff it holds a Delaunay neighbor of an end. The ball of an
  // edge that is not Delaunay always holds one.
  // Where the curve turns sharply at an edge of the box, the ball may hold the next vertex of the
  // chain, however short the edges are. The edge is still Delaunay, so that vertex is ignored.
  bool is_delaunay = false;
  for (const SiteId v : restricted_.neighbors(a)) {
    is_delaunay |= v == b;
    if (v == b || v == chain_.next(b) || v == chain_.previous(a)) continue;
    if (in_diametral_ball(t.point(a), t.point(b), t.point(v))) return true;
  }
  return !is_delaunay;
}

void Recovery::protect_boundary() {
  const std::size_t count = restricted_.triangulation().vertex_capacity();
  for (SiteId v = 1; v < count; ++v) {
    while (chain_.is_boundary(v) && is_encroached(v)) {
      if (follower_) follower_->edge_asked(v, chain_.next(v));
      if (!split_edge(v)) break;
    }
  }
}

void Recovery::multi_intersect() {
  std::deque<std::pair<RecordId, std::uint32_t>> queue;
  for (RecordId r = 0; r < restricted_.record_capacity(); ++r) {
    queue.emplace_back(r, restricted_.generation(r));
  }
  const Triangulation& t = restricted_.triangulation();
  while (!queue.empty()) {
    steps_.step(queue.size());
    const auto [r, generation] = queue.front();
    queue.pop_front();
    const std::span<const Vec3> hits = restricted_.effective_hits(r);
    if (restricted_.generation(r) != generation || hits.size() < 2) continue;
    // All hits lie on the facet's dual line, so the furthest from a corner is the furthest from the
    // facet.
    const Vec3& a = t.point(restricted_.triangle(r)[0]);
    const Vec3 x = *std::max_element(hits.begin(), hits.end(), [&](const Vec3& p, const Vec3& q) {
      return distance2(p, a) < distance2(q, a);
    });
    if (follower_) {
      follower_->record_asked(r, Reason::several_hits, static_cast<double>(hits.size()));
    }
    if (insert(r, x) == Attempt::split) created_.push_back(r);
    for (const RecordId n : created_) queue.emplace_back(n, restricted_.generation(n));
  }
}

bool Recovery::is_manifold_at(SiteId q) {
  restricted_.star(q, star_);
  triangles_.clear();
  for (const RecordId r : star_) triangles_.push_back(as_mesh_triangle(restricted_.triangle(r)));
  const Star star = classify_star(VertexId(q.number()), triangles_);
  if (!chain_.is_boundary(q)) return star == Star::disk;
  if (star != Star::half_disk) return false;
  // The half disk must end on the chain: each chain neighbor of q is in one facet of the star.
  for (const SiteId end : {chain_.next(q), chain_.previous(q)}) {
    const auto holds = [end](const Triangle& v) { return has_corner(v, VertexId(end.number())); };
    if (std::count_if(triangles_.begin(), triangles_.end(), holds) != 1) return false;
  }
  return true;
}

void Recovery::extract_manifold() {
  const Triangulation& t = restricted_.triangulation();
  while (!vertex_queue_.empty()) {
    steps_.step(vertex_queue_.size());
    const SiteId q = vertex_queue_.front();
    vertex_queue_.pop_front();
    vertex_queued_[q] = 0;
    if (is_manifold_at(q)) continue;

    // The surface point of D_q furthest from q.
    RecordId furthest = kNoId;
    Vec3 x;
    double furthest2 = 0;
    for (const RecordId r : star_) {
      for (const Vec3& hit : restricted_.effective_hits(r)) {
        const double d2 = distance2(hit, t.point(q));
        if (furthest != kNoId && d2 <= furthest2) continue;
        furthest = r;
        furthest2 = d2;
        x = hit;
      }
    }
    if (follower_) follower_->star_asked(q, chain_.is_boundary(q), furthest);
    if (furthest != kNoId) {
      if (insert(furthest, x) != Attempt::refused) queue_vertex(q);
    } else if (chain_.is_boundary(q)) {
      const SiteId before = chain_.previous(q), after = chain_.next(q);
      const bool longer =
          distance2(t.point(before), t.point(q)) > distance2(t.point(q), t.point(after));
      split_edge(longer ? before : q);
    }
  }
}

void Recovery::approximate_geom(const Criteria& criteria, std::vector<double>& poles) {
  struct Item {
    double violation;
    RecordId record;
    std::uint32_t generation;
    // The worst first; equal ones by record, so that every run has the same order.
    bool operator<(const Item& o) const {
      return violation != o.violation ? violation < o.violation : record > o.record;
    }
  };
  const Triangulation& t = restricted_.triangulation();
  std::priority_queue<Item> queue;
  const auto shape_of = [&](RecordId r) {
    const SiteTriangle v = restricted_.triangle(r);
    FacetShape shape =
        measure(t.point(v[0]), t.point(v[1]), t.point(v[2]), restricted_.surface_point(r));
    if (!poles.empty()) shape.pole = (poles[v[0]] + poles[v[1]] + poles[v[2]]) / 3;
    return shape;
  };
  const auto enqueue = [&](RecordId r) {
    if (!restricted_.is_restricted(r)) return;
    const double worst = violation(shape_of(r), criteria);
    if (worst > 1) queue.push({worst, r, restricted_.generation(r)});
  };
  for (RecordId r = 0; r < restricted_.record_capacity(); ++r) enqueue(r);
  while (!queue.empty()) {
    steps_.step(queue.size());
    const auto [over, r, generation] = queue.top();
    queue.pop();
    if (restricted_.generation(r) != generation || !restricted_.is_restricted(r)) continue;
    if (follower_) {
      follower_->record_asked(r, reason_of(worst_criterion(shape_of(r), criteria)), over);
    }
    if (insert(r, restricted_.surface_point(r)) == Attempt::split) created_.push_back(r);
    while (!poles.empty() && poles.size() < t.vertex_capacity()) estimate_pole(poles);
    for (const RecordId n : created_) enqueue(n);
  }
}

void Recovery::estimate_pole(std::vector<double>& poles) {
  const SiteId v(poles.size());
  restricted_.star(v, star_);
  double sum = 0;
  std::size_t count = 0;
  for (const RecordId r : star_) {
    for (const SiteId w : restricted_.triangle(r)) {
      if (w >= v) continue;
      sum += poles[w];
      ++count;
    }
  }
  poles.push_back(count > 0 ? sum / static_cast<double>(count) : kNotAsked);
}

void Recovery::count_unresolved() {
  for (RecordId r = 0; r < restricted_.record_capacity(); ++r) {
    report_[Counter::cancelled_pairs] += restricted_.cancelled_pairs(r);
    report_[Counter::unresolved_facets] += restricted_.effective_hits(r).size() > 1;
  }
  for (SiteId v = 1; v < restricted_.triangulation().vertex_capacity(); ++v) {
    if (!restricted_.is_auxiliary(v) && !is_manifold_at(v)) ++report_[Counter::unresolved_vertices];
  }
}

SurfaceMesh recover_paper(const Isosurface& surface, const BoundaryCurves& curves,
                          FirstSample first, const Parameters& parameters, bool single_stage,
                          Report& report) {
  std::optional<StepTimer> timer(report.seconds_recover);
  Recovery recovery(surface, curves, std::move(first), parameters, report);
  recovery.recover();
  const RestrictedDelaunay& restricted = recovery.restricted();
  const Triangulation& t = restricted.triangulation();
  report.points_recovered = t.vertex_capacity() - 1 - kAuxiliaryVertices;

  timer.reset();
  std::vector<double> poles = compute_poles(t, surface, parameters, report);
  timer.emplace(report.seconds_refine);
  if (single_stage) {
    recovery.begin("refine");
    recovery.approximate_geom(parameters.refinement, poles);
    recovery.extract_manifold();
    if (!poles.empty()) poles.resize(t.vertex_capacity(), 0);
  }
  if (Observer* const observer = follower(parameters.observer)) observer->recovery_finished();
  recovery.count_unresolved();
  std::vector<Triangle> facets;
  std::vector<Dual> duals;
  for (RecordId r = 0; r < restricted.record_capacity(); ++r) {
    if (!restricted.is_restricted(r)) continue;
    const auto [a, b, c] = restricted.triangle(r);
    facets.push_back(as_mesh_triangle({a, b, c}));
    duals.push_back(dual_at(t.point(a), t.point(b), t.point(c), restricted.surface_point(r)));
  }
  SurfaceMesh mesh =
      build_tri_mesh(t, std::move(facets), std::move(duals), recovery.chain(), poles);
  orient(mesh, surface);
  return mesh;
}

}  // namespace deliso
