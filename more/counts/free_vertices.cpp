// SPDX-License-Identifier: MIT
#include "more/counts/free_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "more/counts/orientation.h"

namespace deliso {
namespace {

// The weight of a vertex's own place, as a share of the sum of all weights. With .3 mean distances
// are 20 % larger; with .01 they are 5 % smaller, and shapes are worse.
constexpr double kStay = 0.05;
// A move is made if it lowers the sum by this share; else half of it is tried, and a quarter.
constexpr double kLeastGain = 0.005;
constexpr int kTries = 3;
// A point of a facet looks for Sigma as far as the facet is wide, or this far.
constexpr double kLeastSearchVoxels = 2;
// Largest r/l after a move, as a share of its limit, unless it was larger before. Below 1: many
// facets end at it.
constexpr double kShapeShare = 0.95;

// Points of a triangle, as shares of its corners: the middles of the nine triangles into which the
// thirds of its sides divide it.
constexpr std::array<std::uint8_t, 27> kNinths{7, 1, 1, 1, 7, 1, 1, 1, 7, 4, 4, 1, 4, 1,
                                               4, 1, 4, 4, 5, 2, 2, 2, 5, 2, 2, 2, 5};
constexpr std::size_t kPlaces = kNinths.size() / 3;

// The least squares of a vertex.
struct Fit {
  std::array<Vec3, 3> columns;
  Vec3 right, normal;

  // Adds a point that the vertex moves by a share of its own move, and that wants to move by
  // `distance` along n.
  void add(const Vec3& n, double distance, double share, double weight) {
    for (int i = 0; i < 3; ++i) columns[i] = columns[i] + weight * share * share * n[i] * n;
    right = right + weight * share * distance * n;
    normal = normal + weight * n;
  }
  // Returns the best move; 0 if nothing was added.
  Vec3 move() const {
    auto [a, b, c] = columns;
    const double stay = kStay * (a.x + b.y + c.z);
    a.x += stay, b.y += stay, c.z += stay;
    const double volume = dot(cross(a, b), c);
    if (!(volume > 0)) return {};
    return Vec3{dot(cross(b, c), right), dot(cross(c, a), right), dot(cross(a, b), right)} / volume;
  }
};

class Freeing {
 public:
  Freeing(Refinement& r, double within)
      : r_(r),
        orientation_(r),
        within_(within),
        ratio_(kShapeShare * r.parameters.refinement[Criterion::r_over_l]),
        facet_(r.mesh.points.size(), kNoId),
        is_due_(r.mesh.points.size(), 1) {
    for (FaceId f = 0; f < r.mesh.faces.size(); ++f) {
      if (is_dead(r.mesh.faces[f])) continue;
      for (const VertexId v : r.mesh.faces[f].v) facet_[v] = f;
    }
  }

  void sweep(Steps& steps) {
    for (VertexId v = 0; v < facet_.size(); ++v) {
      if (facet_[v] == kNoId || r_.s.chain.is_boundary(v)) continue;
      if (!std::exchange(is_due_[v], 0)) continue;
      steps.step(facet_.size() - v);
      move(v);
    }
  }

 private:
  // Returns the sum of the squared distances of a facet times its area. `fit`: of its corner v.
  double squares(const Triangle& t, VertexId v = kNoId, Fit* fit = nullptr) {
    const Vec3 area = r_.normal(t);
    const double size = length(area), weight = size / kPlaces;
    const double limit = std::max(std::sqrt(size), kLeastSearchVoxels * r_.parameters.voxel);
    if (!(size > 0)) return kNotAsked;
    double sum = 0;
    for (std::size_t n = 0; n < kPlaces; ++n) {
      const std::uint8_t* share = &kNinths[3 * n];
      Vec3 p;
      for (int i = 0; i < 3; ++i) p = p + share[i] / 9. * r_.point(t[i]);
      const auto x = r_.finder.nearest(p, area / size, limit, r_.report.searches_refine);
      const Vec3 gradient = x ? r_.surface.gradient(*x) : Vec3{};
      const double steepness = length(gradient);
      const Vec3 normal = steepness > 0 ? gradient / -steepness : Vec3{};
      const double distance = steepness > 0 ? dot(normal, *x - p) : limit;
      sum += weight * distance * distance;
      if (fit) fit->add(normal, distance, share[t[0] == v ? 0 : t[1] == v ? 1 : 2] / 9., weight);
    }
    return sum;
  }
  double worst_ratio2(const Disk& star) const {
    double worst = 0;
    for (const auto& [a, b, c] : star.facets) {
      worst = std::max(worst, radius_ratio2(r_.point(a), r_.point(b), r_.point(c)));
    }
    return worst;
  }

  void move(VertexId v) {
    const Cavity* cavity = r_.open(r_.star(facet_[v], v));
    if (!cavity) return;
    const Question question(r_, v, reason_of(Criterion::distance));
    Fit fit;
    double before = 0;
    for (const Triangle& t : cavity->disk.facets) before += squares(t, v, &fit);
    const double ratio2 = std::max(ratio_ * ratio_, worst_ratio2(cavity->disk));
    const auto is_better = [&](const Replacement& c) {
      if (!c.duals.empty()) return true;
      double after = 0;
      for (const Triangle& t : c.in().facets) after += squares(t);
      return after < (1 - kLeastGain) * before && worst_ratio2(c.in()) <= ratio2;
    };
    const auto move_to = [&](const Vec3& to) -> std::optional<Refusal> {
      if (!r_.finder.foot(to, fit.normal, within_, r_.report.searches_refine)) {
        return Refusal::no_surface_point;
      }
      if (orientation_.reverses(cavity->facets, v, to)) return Refusal::turned;
      if (orientation_.passes_component(cavity->disk, v, to)) return Refusal::passes_component;
      return r_.make(cavity->move(v, to, {.surface_points = false}), is_better);
    };
    Vec3 by = fit.move();
    for (int n = 0; n < kTries && length2(by) > 0; ++n, by = by / 2) {
      if (r_.done(Operation::move, move_to(r_.point(v) + by))) continue;
      orientation_.merged(v, v);
      for (const FaceId f : r_.created()) {
        for (const VertexId u : r_.mesh.faces[f].v) facet_[u] = f, is_due_[u] = 1;
      }
      return;
    }
  }

  Refinement& r_;
  Orientation orientation_;
  const double within_, ratio_;
  IdArray<VertexId, FaceId> facet_;         // one at the vertex; kNoId: none
  IdArray<VertexId, std::uint8_t> is_due_;  // a facet there has changed since it was tried
};

}  // namespace

void free_vertices(Refinement& r, double within, int sweeps) {
  Freeing freeing(r, within);
  Steps steps(r.parameters.observer);
  for (int n = 0; n < sweeps; ++n) freeing.sweep(steps);
}

}  // namespace deliso
