// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/triangle.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// How far a vertex is moved, in r_min, and in how many directions.
constexpr std::array kSteps{0.5, 0.2, 0.08};
constexpr int kDirections = 8;

// The share of itself by which the cost around a vertex must fall, so that moves end.
constexpr double kMinFall = 0.05;

// How often a vertex is tried: flips and insertions near by raise again what a move has lowered, so
// moves would not end. 12 leaves as many facets over a limit as no bound does (TOOTH, ANEURISM,
// BABY, LEG, three seeds each), 8 up to a sixth more.
constexpr std::uint8_t kMaxTries = 12;

// What a facet costs that is not Delaunay; one over a limit costs 1 and how much it is over.
constexpr double kNotDelaunay = 0.3;

double cost_of_shape(double violation) {
  return violation > 1 ? violation : 0;
}

double cost(const Refinement& r, const Triangle& v, const Dual& dual) {
  const bool is_delaunay = dual.on_surface && !r.holds_vertex(v, dual);
  return cost_of_shape(r.violation(v, dual)) + (is_delaunay ? 0 : kNotDelaunay);
}

// Of facets across the cavity's boundary: they stay, but a vertex may move into their balls.
double cost_of_ball(const Refinement& r, FaceId f) {
  return r.is_delaunay(f) ? 0 : kNotDelaunay;
}

// A lower bound on the cost of the star of the moving vertex were it at p, without a search: as if
// every facet's surface point were its circumcenter.
double least_cost(const Refinement& r, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : r.change.in.facets) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return t[i] == r.change.vertex ? p : r.point(t[i]);
    };
    const Vec3 &a = corner(0), &b = corner(1), &c = corner(2);
    const FacetShape shape = measure(a, b, c, circumcenter(a, b, c));
    sum += cost_of_shape(violation(shape, r.parameters.refinement));
  }
  return sum;
}

std::optional<Refusal> move_vertex(Refinement& r, FaceId f, VertexId v) {
  if (r.s.chain.is_boundary(v)) return Refusal::boundary;
  Change& c = r.begin_change(kSharpestFold);
  facets_around(r.mesh, f, v, c.cavity);
  if (const auto refusal = r.open_cavity(c)) return refusal;
  c.in.facets = c.was.facets;
  c.what = Change::Vertex::moves;
  c.vertex = v;

  Vec3 normal;
  double here = 0;
  std::vector<FaceId> across;
  for (const FaceId g : c.cavity) {
    const Triangle& t = r.mesh.faces[g].v;
    normal = normal + area_normal(r.point(t[0]), r.point(t[1]), r.point(t[2]));
    here += cost(r, t, r.s.duals[g]);
  }
  for (const Disk::BoundaryEdge& e : c.was.boundary) {
    const FaceId g = r.mesh.faces[c.cavity[e.facet]].n[e.side];
    if (g == kNoId) continue;
    across.push_back(g);
    here += cost_of_ball(r, g);
  }
  const double size = length(normal);
  r.move_tries.resize(r.mesh.points.size(), 0);
  if (!(size > 0) || here == 0 || r.move_tries[v] == kMaxTries) return Refusal::no_gain;
  ++r.move_tries[v];
  normal = normal / size;
  const Vec3 sideways = cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 u = sideways / length(sideways), w = cross(normal, u);

  const Vec3 from = r.point(v);
  double least = (1 - kMinFall) * here;
  SearchCounters& searches = r.report.searches_refine;
  // Added up facet by facet, and given up as soon as it cannot be the least.
  const auto cost_there = [&] {
    double sum = 0;
    for (std::size_t k = 0; k < across.size() && sum < least; ++k)
      sum += cost_of_ball(r, across[k]);
    c.duals.clear();
    std::ptrdiff_t allowed = r.facets_without_point(c);
    for (std::size_t k = 0; k < c.in.facets.size() && sum < least; ++k) {
      if (!r.find_dual(c, k, allowed)) return least;
      sum += cost(r, c.in.facets[k], c.duals[k]);
    }
    return sum;
  };
  std::optional<Vec3> best;
  for (const double step : kSteps) {
    const double reach = step * r.parameters.r_min;
    for (int d = 0; d < kDirections && least > 0; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      const Vec3 to = from + (reach * std::cos(angle)) * u + (reach * std::sin(angle)) * w;
      const auto there = r.finder.foot(to, normal, reach, searches);
      if (!there || least_cost(r, *there) >= least) continue;
      c.place = *there;
      const std::optional<double> sum = r.cost_of_move(c, cost_there);
      if (!sum || *sum >= least || !r.finder.on_one_sheet(from, *there, normal, searches)) continue;
      least = *sum;
      best = there;
    }
  }
  if (!best) return r.done(Rung::move, Refusal::no_gain);
  c.place = *best;
  return r.done(Rung::move, r.replace(c, [] { return true; }));
}

}  // namespace

std::optional<Refusal> move_corner(Refinement& r, FaceId f) {
  std::optional<Refusal> refusal;
  for (const VertexId v : Triangle(r.mesh.faces[f].v)) {
    refusal = move_vertex(r, f, v);
    if (!refusal) break;
  }
  return refusal;
}

}  // namespace deliso
