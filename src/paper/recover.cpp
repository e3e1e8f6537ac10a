// SPDX-License-Identifier: MIT
#include "paper/recover.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>

#include "base/check.h"
#include "base/sorted_list.h"
#include "paper/build_tri_mesh.h"
#include "stage1/poles.h"
#include "surface/criteria.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// Balls below this share of r_min are left alone: without a floor, sheets of pure noise that come
// arbitrarily close would be refined for ever.
constexpr double kFloor = 0.01;

// A hit is real only if no vertex lies deeper in its ball than rounding explains.
constexpr double kBallTolerance = 0.999;

// Boundary edges shorter than this share of a voxel are not split either: two curves a hair apart
// encroach upon each other however short their edges are.
constexpr double kShortestVoxelShare = 0.02;

}  // namespace

Recovery::Recovery(RestrictedDelaunay& restricted, const BoundaryCurves& curves, SiteChain& chain,
                   const Parameters& parameters)
    : restricted_(restricted),
      curves_(curves),
      chain_(chain),
      parameters_(parameters),
      steps_(parameters.observer),
      report_(restricted.report()),
      floor_(kFloor * parameters.r_min),
      shortest_edge_(std::max(kShortestBoundaryEdge * parameters.r_min,
                              kShortestVoxelShare * parameters.voxel)) {
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
  check_room();
}

void Recovery::check_room() const {
  if (restricted_.triangulation().vertex_capacity() > parameters_.max_vertices) {
    throw InputError("more than --max-vertices " + std::to_string(parameters_.max_vertices) +
                     " vertices needed before the surface is recovered");
  }
}

std::optional<SiteId> Recovery::encroached_edge(const Vec3& p,
                                                std::span<const CellId> cells) const {
  const Triangulation& t = restricted_.triangulation();
  std::optional<SiteId> worst;
  double worst_length2 = 0;
  const auto consider = [&](SiteId a) {
    const Vec3 &pa = t.point(a), &pb = t.point(chain_.next(a));
    const double length2 = distance2(pa, pb);
    const bool longer =
        length2 > worst_length2 || (length2 == worst_length2 && worst && a < *worst);
    if (longer && in_diametral_ball(pa, pb, p)) {
      worst = a;
      worst_length2 = length2;
    }
  };
  for (const CellId c : cells) {
    for (const SiteId v : t.vertices(c)) {
      if (!chain_.is_boundary(v)) continue;
      consider(v);
      consider(chain_.previous(v));
    }
  }
  return worst;
}

Attempt Recovery::insert(RecordId r, const Vec3& x) {
  created_.clear();
  const Attempt attempt = try_insert(r, x);
  if (Observer* const follower = restricted_.follower()) follower->attempt_ended(attempt, x);
  return attempt;
}

Attempt Recovery::try_insert(RecordId r, const Vec3& x) {
  const Triangulation& t = restricted_.triangulation();
  const double radius = distance(x, t.point(restricted_.triangle(r)[0]));
  if (radius < floor_) {
    ++report_[Counter::capped_insertions];
    return Attempt::refused;
  }
  const ConflictZone& zone = restricted_.prepare(x, restricted_.facet(r).cell);
  if (zone.duplicate != kNoId || restricted_.distance_to_vertices(x) < kBallTolerance * radius) {
    for (const SiteId v : restricted_.triangle(r)) queue_vertex(v);
    restricted_.forget(r);
    return Attempt::forgotten;
  }
  if (const auto edge = encroached_edge(x, zone.cells)) {
    return split_edge(*edge) ? Attempt::split : Attempt::refused;
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
    if (any && !edge_holds_a_vertex(from)) continue;
    const auto middle = distance(pa, pb) < shortest_edge_
                            ? std::nullopt
                            : curves_.split(chain_.place(from), pa, chain_.place(to), pb);
    if (!middle) {
      ++report_[Counter::refused_splits];
      continue;
    }
    const ConflictZone& zone = restricted_.prepare(middle->point, t.incident_cell(from));
    if (zone.duplicate != kNoId) {
      ++report_[Counter::refused_splits];
      continue;
    }
    std::vector<SiteId> near;
    for (const CellId c : zone.cells) {
      for (const SiteId v : t.vertices(c)) {
        if (chain_.is_boundary(v)) near.push_back(v);
      }
    }
    if (restricted_.follower()) restricted_.follower()->edge_split(from, to);
    const SiteId v = restricted_.insert_prepared(middle->point);
    chain_.insert_after(from, v, middle->place);
    queue_vertex(from);
    queue_vertex(to);
    after_insertion();
    ++report_[Counter::boundary_splits_recover];
    any = true;
    // The two halves may hold older vertices; edges near by may hold the new one.
    sort_out(near);
    for (const SiteId w : near) {
      for (const SiteId b : {w, chain_.previous(w)}) {
        if (in_diametral_ball(t.point(b), t.point(chain_.next(b)), middle->point)) {
          pending.push_back(b);
        }
      }
    }
    pending.push_back(v);
    pending.push_back(from);
  }
  return any;
}

bool Recovery::edge_holds_a_vertex(SiteId a) {
  const Triangulation& t = restricted_.triangulation();
  const SiteId b = chain_.next(a);
  // The ball of an edge holds a vertex iff it holds a Delaunay neighbour of an end; so does that
  // of an edge which is not Delaunay.
  // Where the curve turns sharply at an edge of the box the next vertex along it may lie in the
  // ball however short the edges are; the edge is Delaunay all the same.
  for (const SiteId v : restricted_.neighbors(a)) {
    if (v == b || v == chain_.next(b) || v == chain_.previous(a)) continue;
    if (in_diametral_ball(t.point(a), t.point(b), t.point(v))) return true;
  }
  const auto around = restricted_.neighbors(a);
  return std::find(around.begin(), around.end(), b) == around.end();
}

void Recovery::protect_boundary() {
  const std::size_t count = restricted_.triangulation().vertex_capacity();
  for (SiteId v = 1; v < count; ++v) {
    while (chain_.is_boundary(v) && edge_holds_a_vertex(v)) {
      if (restricted_.follower()) restricted_.follower()->edge_asked(v, chain_.next(v));
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
  Observer* const follower = restricted_.follower();
  while (!queue.empty()) {
    steps_.step(queue.size());
    const auto [r, generation] = queue.front();
    queue.pop_front();
    if (!restricted_.is_live(r) || restricted_.generation(r) != generation) continue;
    const std::span<const Vec3> hits = restricted_.effective_hits(r);
    if (hits.size() < 2) continue;
    // All hits lie on the facet's dual line: furthest from a corner is furthest from the facet.
    const Vec3& a = t.point(restricted_.triangle(r)[0]);
    const Vec3 x = *std::max_element(hits.begin(), hits.end(), [&](const Vec3& p, const Vec3& q) {
      return distance2(p, a) < distance2(q, a);
    });
    if (follower) {
      follower->record_asked(r, Reason::several_hits, static_cast<double>(hits.size()));
    }
    const Attempt attempt = insert(r, x);
    if (attempt == Attempt::inserted || attempt == Attempt::split) {
      for (const RecordId n : created_) queue.emplace_back(n, restricted_.generation(n));
      if (attempt == Attempt::split) queue.emplace_back(r, restricted_.generation(r));
    }
  }
}

bool Recovery::is_manifold_at(SiteId q) {
  restricted_.star(q, star_);
  triangles_.clear();
  for (const RecordId r : star_) triangles_.push_back(as_mesh_triangle(restricted_.triangle(r)));
  const Star star = classify_star(VertexId(q.number()), triangles_);
  if (!chain_.is_boundary(q)) return star == Star::disk;
  if (star != Star::half_disk) return false;
  // The fan must end on the chain: an end's vertex lies on one triangle of the star only.
  for (const SiteId end : {chain_.next(q), chain_.previous(q)}) {
    const auto holds = [end](const Triangle& v) { return has_corner(v, VertexId(end.number())); };
    if (std::count_if(triangles_.begin(), triangles_.end(), holds) != 1) return false;
  }
  return true;
}

void Recovery::extract_manifold() {
  const Triangulation& t = restricted_.triangulation();
  Observer* const follower = restricted_.follower();
  while (!vertex_queue_.empty()) {
    steps_.step(vertex_queue_.size());
    const SiteId q = vertex_queue_.front();
    vertex_queue_.pop_front();
    vertex_queued_[q] = 0;
    bool is_manifold = false;
    {
      const Working working(follower, Activity::disk_test, report_.searches_recover);
      is_manifold = is_manifold_at(q);
    }
    if (is_manifold) continue;

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
    if (follower) follower->star_asked(q, chain_.is_boundary(q), furthest);
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
    // Worst first; equal ones by record, so that the order is the same in every run.
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
  const auto judge = [&](RecordId r) {
    if (!restricted_.is_live(r) || !restricted_.is_restricted(r)) return;
    const double worst = violation(shape_of(r), criteria);
    if (worst > 1) queue.push({worst, r, restricted_.generation(r)});
  };
  for (RecordId r = 0; r < restricted_.record_capacity(); ++r) judge(r);
  while (!queue.empty()) {
    steps_.step(queue.size());
    const Item item = queue.top();
    queue.pop();
    const RecordId r = item.record;
    if (!restricted_.is_live(r) || restricted_.generation(r) != item.generation) continue;
    if (!restricted_.is_restricted(r)) continue;
    const std::size_t before = t.vertex_capacity();
    if (restricted_.follower()) {
      const Criterion worst = worst_criterion(shape_of(r), criteria);
      restricted_.follower()->record_asked(r, reason_of(worst), item.violation);
    }
    const Attempt attempt = insert(r, restricted_.surface_point(r));
    if (!poles.empty()) {
      for (SiteId v = SiteId(before); v < t.vertex_capacity(); ++v) {
        estimate_pole(v, poles);
      }
    }
    if (attempt == Attempt::inserted || attempt == Attempt::split) {
      for (const RecordId n : created_) judge(n);
      if (attempt == Attempt::split) judge(r);
    }
  }
}

void Recovery::estimate_pole(SiteId v, std::vector<double>& poles) {
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
  poles.push_back(count > 0 ? sum / static_cast<double>(count)
                            : std::numeric_limits<double>::infinity());
}

void Recovery::count_unresolved() {
  for (RecordId r = 0; r < restricted_.record_capacity(); ++r) {
    if (!restricted_.is_live(r)) continue;
    report_[Counter::cancelled_pairs] += restricted_.cancelled_pairs(r);
    if (restricted_.effective_hits(r).size() > 1) ++report_[Counter::unresolved_facets];
  }
  for (SiteId v = 1; v < restricted_.triangulation().vertex_capacity(); ++v) {
    if (!restricted_.is_auxiliary(v) && !is_manifold_at(v)) ++report_[Counter::unresolved_vertices];
  }
}

SurfaceMesh recover_paper(const Isosurface& surface, const BoundaryCurves& curves,
                          FirstSample first, const Parameters& parameters, bool single_stage,
                          Report& report) {
  std::optional<StepTimer> timer(report.seconds_recover);
  RestrictedDelaunay restricted(surface, std::move(first.triangulation), parameters.r_min, report,
                                follower(parameters.observer));
  Recovery recovery(restricted, curves, first.chain, parameters);
  recovery.recover();
  const Triangulation& t = restricted.triangulation();
  report.points_recovered = t.vertex_capacity() - 1 - kAuxiliaryVertices;
  report.insertions_recover =
      report.points_recovered - std::min(report.points_recovered, report.points_initial);

  timer.reset();
  if (parameters.asks_for_poles()) begin_stage(parameters.observer, "poles");
  std::vector<double> poles;
  if (parameters.asks_for_poles()) poles = compute_poles(t, surface, report);
  timer.emplace(report.seconds_refine);
  if (single_stage) {
    recovery.begin("refine");
    recovery.approximate_geom(parameters.refinement, poles);
    recovery.extract_manifold();
    if (!poles.empty()) poles.resize(t.vertex_capacity(), 0);
  }
  if (restricted.follower()) restricted.follower()->recovery_finished();
  recovery.count_unresolved();
  return build_tri_mesh(std::move(restricted), first.chain, poles);
}

}  // namespace deliso
