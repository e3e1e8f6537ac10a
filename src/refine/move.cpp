// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "base/triangle.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// Lengths of moves, in r_min, the longest first. The first place that helps is taken: the best of
// eight costs more and leaves as many bad facets.
constexpr std::array kStepRMins{0.5, 0.2, 0.08};
// Directions of moves: cosine and sine of n pi/4, in double precision. They are numbers because the
// system library's functions differ in their last bits between processors. 6 directions leave 14 %
// more bad facets, 4 leave 38 % more.
struct Direction {
  double cosine, sine;
};
constexpr std::array<Direction, 8> kDirections{{{1, 0},
                                                {0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bccp-1},
                                                {0x1.1a62633145c07p-54, 1},
                                                {-0x1.6a09e667f3bccp-1, 0x1.6a09e667f3bcdp-1},
                                                {-1, 0x1.1a62633145c07p-53},
                                                {-0x1.6a09e667f3bcep-1, -0x1.6a09e667f3bccp-1},
                                                {-0x1.a79394c9e8a0ap-53, -1},
                                                {0x1.6a09e667f3bcbp-1, -0x1.6a09e667f3bcep-1}}};

// Least relative decrease of the cost around a vertex by a move, so that moves end.
constexpr double kMinCostFall = 0.05;

// Most moves tried for a vertex. Near flips and insertions raise the cost again, so moves would not
// end. With 12 as many facets stay bad as without a limit (docs/decisions.md).
constexpr std::uint8_t kMaxTries = 12;

// Cost of a facet that is not Delaunay, added to the violation of a bad one.
constexpr double kNotDelaunayCost = 0.3;

double cost_of_shape(const Refinement& r, const FacetShape& shape) {
  const double violation = deliso::violation(shape, r.parameters.refinement);
  return violation > 1 ? violation : 0;
}

double cost(const Refinement& r, const Triangle& v, const Dual& dual) {
  return cost_of_shape(r, r.shape(v, dual)) + (r.is_delaunay(v, dual) ? 0 : kNotDelaunayCost);
}

// Returns the cost of a facet whose dual is not known yet, or less: as if Sigma passed through its
// circumcenter.
double least_cost(const Refinement& r, const Triangle& v) {
  FacetShape shape = r.shape(v, {});
  shape.h = 0;
  return cost_of_shape(r, shape);
}

// The surface ball of a facet across the boundary of a vertex's star. The facet stays, but the
// vertex may move into its ball. Whether the ball holds another vertex does not change.
struct Ball {
  Dual dual;
  bool is_delaunay;  // if the vertex is not in it
};

double cost_of(const std::vector<Ball>& across, const Vec3& p) {
  const auto costs = [&](const Ball& b) { return !b.is_delaunay || b.dual.holds(p); };
  return kNotDelaunayCost * static_cast<double>(std::ranges::count_if(across, costs));
}

// Moves v along the plane with this normal and back to Sigma. Returns false if no place of the 24
// passes.
bool try_places(Refinement& r, const Cavity& star, VertexId v, const Vec3& normal,
                const Refinement::Accept& accept) {
  const Vec3 sideways = cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 u = sideways / length(sideways), w = cross(normal, u);
  const Vec3 from = r.point(v);
  for (const double step : kStepRMins) {
    const double reach = step * r.parameters.r_min;
    for (const auto& [cosine, sine] : kDirections) {
      const Vec3 to = from + (reach * cosine) * u + (reach * sine) * w;
      const auto foot = r.finder.foot(to, normal, reach, r.report.searches_refine);
      if (foot && !r.make(star.move(v, *foot, Gates{}), accept)) return true;
    }
  }
  return false;
}

std::optional<Refusal> move_vertex(Refinement& r, FaceId f, VertexId v) {
  if (r.s.chain.is_boundary(v)) return Refusal::boundary;
  r.moves.resize(r.mesh.points.size());
  if (r.moves[v].are_vain) return Refusal::no_gain;
  const Cavity* cavity = r.open(r.star(f, v));
  if (!cavity) return Refusal::not_a_disk;
  Vec3 normal;
  double here = 0;
  for (const FaceId g : cavity->facets) {
    const Triangle& t = r.mesh.faces[g].v;
    normal = normal + r.normal(t);
    here += cost(r, t, r.s.duals[g]);
  }
  std::vector<Ball> across;
  for (const FaceId g : cavity->across) {
    if (g == kNoId) continue;
    across.push_back({r.s.duals[g], r.is_delaunay(r.mesh.faces[g].v, r.s.duals[g], v)});
  }
  const Vec3 from = r.point(v);
  here += cost_of(across, from);
  const double size = length(normal);
  if (!(size > 0) || here == 0 || r.moves[v].tries == kMaxTries) return Refusal::no_gain;
  ++r.moves[v].tries;
  normal = normal / size;

  double there = 0;
  // The costs become known facet by facet. False as soon as the cost does not fall far enough.
  const auto lowers_cost = [&](const Replacement& c) {
    const std::vector<Triangle>& facets = c.in().facets;
    if (c.duals.empty()) {
      there = cost_of(across, r.point(v));
      for (const Triangle& t : facets) there += least_cost(r, t);
    } else {
      const Triangle& t = facets[c.duals.size() - 1];
      there += cost(r, t, c.duals.back()) - least_cost(r, t);
    }
    return there < (1 - kMinCostFall) * here;
  };
  r.moves[v].are_vain = !try_places(r, *cavity, v, normal, lowers_cost);
  return r.done(Operation::move,
                r.moves[v].are_vain ? std::optional(Refusal::no_gain) : std::nullopt);
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
