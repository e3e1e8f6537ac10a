// SPDX-License-Identifier: MIT
#include "paper/recover.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "base/check.h"
#include "isosurface/boundary_midpoint.h"
#include "mesh/star.h"
#include "paper/facet_cycles.h"

namespace deliso::paper {
namespace {

// Of a voxel: shorter edges of the boundary curves are not split. Two curves very near to each
// other encroach upon each other however short their edges are.
constexpr double kShortestEdge = 0.02;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

}  // namespace

const Hit& furthest(std::span<const Hit> hits, const Vec3& p) {
  return *std::ranges::max_element(hits, {}, [&](const Hit& x) { return distance2(x.point, p); });
}

const Hit& nearest(std::span<const Hit> hits, const Vec3& p) {
  return *std::ranges::min_element(hits, {}, [&](const Hit& x) { return distance2(x.point, p); });
}

void require_few(std::size_t vertices, const Options& options) {
  if (vertices <= options.max_vertices) return;
  throw InputError("more than --max-vertices ", options.max_vertices, " vertices needed");
}

Recovery::Recovery(RestrictedDelaunay del, const BoundaryCurves& curves,
                   std::span<const SiteId> ids, const Options& options, Report& report)
    : del_(std::move(del)),
      options_(options),
      report_(report),
      steps_(options.observer),
      shortest_edge_(kShortestEdge * del_.sigma().volume().voxel()),
      curve_(del_.del().vertex_capacity()) {
  for (const auto& [a, b, face] : curves.edges) {
    if (ids[a] == ids[b]) continue;
    curve_[ids[a]].push_back({ids[b], face});
    curve_[ids[b]].push_back({ids[a], face});
  }
  for (SiteId q = 1; q < del_.del().vertex_capacity(); ++q) queue(q);
  require_few(report.points_initial(), options);
}

void Recovery::recover() {
  multi_intersect();
  extract_manifold();
  approximate_geom(options_.epsilon);
  extract_manifold();
}

template <class Visit>
void Recovery::for_each_facet(Visit&& visit) {
  const Triangulation& t = del_.del();
  facets_.clear();
  deliso::for_each_facet(t, [&](Facet f) {
    if (!del_.hits(f).empty()) queue(f);
  });
  while (!facets_.empty()) {
    steps_.step(facets_.size());
    const auto [f, corners] = facets_.front();
    facets_.pop_front();
    // Its cell may be gone, and its number another cell's.
    if (!t.is_live(f.cell) || facet_vertices(t, f) != corners || del_.hits(f).empty()) continue;
    visit(f);
  }
}

void Recovery::multi_intersect() {
  for_each_facet([&](Facet sigma) {
    const std::span<const Hit> x = del_.hits(sigma);
    if (x.size() < 2) return;
    // All of them are on the dual line, whose points are as far from one corner as from the others.
    const Vec3 p = furthest(x, del_.del().point(facet_vertices(del_.del(), sigma)[0])).point;
    if (options_.observer) {
      options_.observer->asks(Reason::several_hits, sigma, kNoId, static_cast<double>(x.size()), p);
    }
    insert(sigma, p);
  });
}

void Recovery::extract_manifold() {
  while (!vertices_.empty()) {
    steps_.step(vertices_.size());
    const SiteId q = vertices_.front();
    vertices_.pop_front();
    is_queued_[q] = 0;
    const bool is_good = is_disk(q);
    if (is_good || star_.empty()) {
      insert_without_hit(q);
      continue;
    }
    const Vec3& at = del_.del().point(q);
    const Facet sigma = *std::ranges::max_element(
        star_, {}, [&](Facet f) { return distance2(furthest(del_.hits(f), at).point, at); });
    const Vec3 p = furthest(del_.hits(sigma), at).point;
    if (options_.observer) {
      options_.observer->asks(on_curve(q) ? Reason::not_a_half_disk : Reason::not_a_disk, sigma, q,
                              static_cast<double>(star_.size()), p);
    }
    if (insert(sigma, p)) queue(q);
  }
}

void Recovery::insert_without_hit(SiteId q) {
  if (del_.is_auxiliary(q)) return;
  std::optional<Vec3> x;
  Reason reason = Reason::not_a_disk;
  if (star_.empty()) x = point_beside(q);
  if (!x && options_.facet_cycles) {
    x = facet_cycle(del_, q, Options::kClosest * report_.r_min, report_.searches_recover);
    reason = Reason::facet_cycle;
  }
  if (!x) return;
  const CellId cell = del_.del().incident_cell(q);
  const Facet at_q{cell, del_.del().vertex(cell, 0) == q ? 1 : 0};
  if (options_.observer) {
    options_.observer->asks(reason, at_q, q, static_cast<double>(star_.size()), *x);
  }
  if (insert(at_q, *x)) queue(q);
}

std::optional<Vec3> Recovery::point_beside(SiteId q) {
  const Triangulation& t = del_.del();
  const Vec3& at = t.point(q);
  const Volume& volume = del_.sigma().volume();
  const Vec3 g = volume.gradient(at);
  const double reach = length(volume.box().size()), least = Options::kClosest * report_.r_min;
  for (const Vec3& along : {length(g) > 0 ? g / length(g) : Vec3{1, 0, 0}, Vec3{1, 0, 0},
                            Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    std::optional<Vec3> x;
    for (const Hit& hit : del_.sigma().intersect({at - reach * along, at + reach * along},
                                                 report_.searches_recover)) {
      const double far = distance(hit.point, at);
      if (far > least && (!x || far < distance(*x, at))) x = hit.point;
    }
    if (!x) continue;
    // The site nearest to x is a vertex of its zone.
    const ConflictZone& zone = del_.find_conflicts(*x, t.incident_cell(q));
    const bool is_in_v_q = std::ranges::none_of(zone.cells, [&](CellId c) {
      return std::ranges::any_of(t.vertices(c), [&](SiteId v) {
        return v != Triangulation::kInfinite && distance2(t.point(v), *x) < distance2(at, *x);
      });
    });
    if (zone.duplicate == kNoId && is_in_v_q) return x;
  }
  return {};
}

bool Recovery::is_disk(SiteId q) {
  del_.star(q, star_);
  std::vector<Triangle> facets;
  for (const Facet f : star_) facets.push_back(as_mesh_triangle(facet_vertices(del_.del(), f)));
  const Star star = classify_star(VertexId(q.number()), facets);
  if (!on_curve(q)) return star == Star::disk;
  const auto ends_there = [&](const CurveEdge& edge) {
    const VertexId to(edge.to.number());
    return std::ranges::count_if(facets, [&](const Triangle& v) { return has_corner(v, to); }) == 1;
  };
  return star == Star::half_disk && std::ranges::all_of(curve_[q], ends_there);
}

void Recovery::approximate_geom(double epsilon, const PoleHeight& pole) {
  for_each_facet([&](Facet sigma) {
    const SiteTriangle v = facet_vertices(del_.del(), sigma);
    const auto at = [&](std::size_t i) { return del_.del().point(v[i]); };
    const Vec3 x = nearest(del_.hits(sigma), at(0)).point;
    const FacetShape m = measure(at(0), at(1), at(2), x);
    if (m.r <= report_.r_min) return;
    const auto [worst, reason] = violation(m, epsilon, pole ? pole(v) : kNoLimit, options_);
    if (worst <= 1) return;
    if (options_.observer) options_.observer->asks(reason, sigma, kNoId, worst, x);
    insert(sigma, x);
  });
}

bool Recovery::refuse(Refusal why) {
  if (options_.observer) options_.observer->refused(why);
  return false;
}

bool Recovery::insert(Facet sigma, const Vec3& x) {
  const Triangulation& t = del_.del();
  const ConflictZone& zone = del_.find_conflicts(x, sigma.cell);
  if (zone.duplicate != kNoId) return refuse(Refusal::vertex_there);
  // Of the curve edges that x encroaches upon, the longest.
  SiteId from = kNoId;
  CurveEdge edge{};
  double longest2 = 0;
  for (const CellId c : zone.cells) {
    for (const SiteId a : t.vertices(c)) {
      if (!on_curve(a)) continue;
      for (const CurveEdge& e : curve_[a]) {
        const Vec3 &p = t.point(a), &q = t.point(e.to);
        if (dot(p - x, q - x) >= 0 || distance2(p, q) <= longest2) continue;
        longest2 = distance2(p, q);
        from = a;
        edge = e;
      }
    }
  }
  if (from != kNoId) return split(from, edge, sigma);
  add_site(x);
  return true;
}

bool Recovery::split(SiteId a, const CurveEdge& edge, Facet sigma) {
  const Triangulation& t = del_.del();
  const Vec3 pa = t.point(a), pb = t.point(edge.to);
  const Volume& volume = del_.sigma().volume();
  std::optional<Vec3> p;
  if (distance(pa, pb) > shortest_edge_) {
    p = boundary_midpoint(volume, del_.sigma().kappa(), edge.face, pa, pb);
  }
  if (!p || del_.find_conflicts(*p, sigma.cell).duplicate != kNoId) {
    ++report_.curve_refusals;
    return refuse(Refusal::at_curve);
  }
  if (options_.observer) options_.observer->refused(Refusal::split);
  queue(sigma);
  const SiteId b = edge.to, v(t.vertex_capacity());
  const BoxFace face = edge.face;
  add_site(*p);
  ++report_.curve_splits;
  curve_.resize(v + 1);
  curve_[v] = {{a, face}, {b, face}};
  // Of two edges with the same ends, on two faces, the first was chosen, which is so at both ends.
  const auto join = [&](SiteId end, SiteId other) {
    std::ranges::find(curve_[end], other, &CurveEdge::to)->to = v;
  };
  join(a, b);
  join(b, a);
  return true;
}

void Recovery::add_site(const Vec3& p) {
  del_.insert(p);
  ++report_.insertions_recover;
  for (const SiteId q : del_.touched()) queue(q);
  for (const Facet f : del_.created()) queue(f);
  // Without the auxiliary vertices and the infinite one.
  require_few(del_.del().vertex_capacity() - kAuxiliaryVertices - 1, options_);
}

void Recovery::queue(SiteId q) {
  if (q >= is_queued_.size()) is_queued_.resize(q + 1, 0);
  if (is_queued_[q] != 0) return;
  is_queued_[q] = 1;
  vertices_.push_back(q);
}

void Recovery::count_left() {
  const Triangulation& t = del_.del();
  deliso::for_each_facet(t, [&](Facet f) { report_.facets_left += del_.hits(f).size() > 1; });
  for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
    if (del_.is_auxiliary(q)) continue;
    const bool is_good = is_disk(q);
    report_.vertices_left += !is_good && !star_.empty();
    report_.vertices_alone += star_.empty();
  }
}

}  // namespace deliso::paper
