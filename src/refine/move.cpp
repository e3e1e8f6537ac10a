// SPDX-License-Identifier: MIT
#include "refine/move.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace deliso {
namespace {

// How far a vertex is moved, as shares of r_min, and in how many directions.
constexpr std::array kSteps{0.5, 0.2, 0.08};
constexpr int kDirections = 8;

// By such a share of itself the cost around a vertex must fall: there is an end to it.
constexpr double kFall = 0.05;

}  // namespace

// Of the star of the vertex at hand were it at p: the part of its cost that asks for no search, as
// if every facet's surface point were its circumcenter.
double Mover::cost_of_needles(const Vec3& p) const {
  double sum = 0;
  for (const Triangle& t : change_.in.facets) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return t[i] == change_.vertex ? p : mesh_.points[t[i]];
    };
    const Vec3 &a = corner(0), &b = corner(1), &c = corner(2);
    const FacetShape shape = measure(a, b, c, circumcenter(a, b, c));
    const double over = violation(shape, parameters_.refinement);
    if (over > 1) sum += over;
  }
  return sum;
}

bool Mover::move(FaceId f, VertexId v) {
  if (s_.chain.is_boundary(v)) return false;
  facets_around(mesh_, f, v, change_.out);
  if (!replacer_.mark_old(change_)) return false;
  change_.in.facets = change_.was.facets;
  change_.what = Change::Vertex::moves;
  change_.vertex = v;
  change_.least_cosine = kSharpest;

  Vec3 normal;
  double here = 0;
  for (const FaceId g : change_.out) {
    const Triangle& t = mesh_.faces[g].v;
    normal = normal + area_normal(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
    here += judge_.cost_of_shape(t, s_.duals[g]) + judge_.cost_of_ball(t, s_.duals[g]);
  }
  watched_.clear();
  for (const Patch::RimEdge& e : change_.was.rim) {
    const FaceId g = mesh_.faces[change_.out[e.facet]].n[e.side];
    if (g == kNoId) continue;
    watched_.push_back(g);
    here += judge_.cost_of_ball(mesh_.faces[g].v, s_.duals[g]);
  }
  const double size = length(normal);
  if (!(size > 0) || here == 0) return false;
  normal = normal / size;
  const Vec3 across = cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 u = across / length(across), w = cross(normal, u);

  const Vec3 from = mesh_.points[v];
  double least = (1 - kFall) * here;
  SurfacePointFinder& finder = replacer_.finder();
  SearchCounters& searches = report_.searches_refine;
  std::optional<Vec3> best;
  // G4, while looking: remembers the least cost that passes G1 to G3, and does nothing.
  const auto weigh = [&] {
    double sum = 0;
    const std::vector<Triangle>& in = change_.in.facets;
    for (std::size_t k = 0; k < in.size(); ++k)
      sum += judge_.cost_of_shape(in[k], change_.duals[k]);
    for (std::size_t k = 0; k < in.size() && sum < least; ++k) {
      sum += judge_.cost_of_ball(in[k], change_.duals[k]);
    }
    for (std::size_t k = 0; k < watched_.size() && sum < least; ++k) {
      sum += judge_.cost_of_ball(mesh_.faces[watched_[k]].v, s_.duals[watched_[k]]);
    }
    if (sum < least && finder.on_one_sheet(from, change_.place, normal, searches)) {
      least = sum;
      best = change_.place;
    }
    return false;
  };
  for (const double step : kSteps) {
    const double reach = step * parameters_.r_min;
    for (int d = 0; d < kDirections && least > 0; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      const Vec3 to = from + (reach * std::cos(angle)) * u + (reach * std::sin(angle)) * w;
      const auto there = finder.foot(to, normal, reach, searches);
      if (!there || cost_of_needles(*there) >= least) continue;
      change_.place = *there;
      replacer_.replace(change_, weigh);
    }
  }
  std::optional<Refusal> refusal = Refusal::no_gain;
  if (best) {
    change_.place = *best;
    refusal = replacer_.replace(change_, [] { return true; });
  }
  return !replacer_.count(Rung::move, change_, refusal);
}

bool Mover::move_corner(FaceId f) {
  const Triangle corners = mesh_.faces[f].v;
  return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return move(f, v); });
}

}  // namespace deliso
