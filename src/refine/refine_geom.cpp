// SPDX-License-Identifier: MIT
#include "refine/refine_geom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/check.h"
#include "base/triangle.h"
#include "refine/coverage.h"
#include "refine/facet_queue.h"
#include "refine/operations.h"

namespace deliso {
namespace {

constexpr std::size_t kNoTarget = std::numeric_limits<std::size_t>::max();

// In voxels: a bound on the distance that no mesh of target_vertices keeps, to begin with.
constexpr double kFinestDistance = 2e-3;

// Facets that meet the criteria and are not Delaunay: those above this share of r_min are refined
// for it, for smaller ones only corners are moved.
constexpr double kSmallForDelaunay = 0.5;

// How often all facets are looked at for that, since what is inserted for some is in the balls of
// others. One round takes 9 % less time, and leaves .05 to .2 points less of the restricted share
// on TOOTH, ANEURISM and Marschner-Lobb's field; a third changes nothing.
constexpr int kDelaunayRounds = 2;

class RefineGeom {
 public:
  RefineGeom(Refinement& refinement, std::span<const Vec3> samples, std::vector<std::uint32_t>& far)
      : r_(refinement),
        mesh_(refinement.mesh),
        samples_(samples),
        far_(far),
        by_count_(refinement.parameters.target_vertices != kNoTarget),
        queue_(refinement.surface.volume().box(), refinement.parameters.voxel, by_count_),
        steps_(refinement.parameters.observer) {}

  std::vector<FaceId> run(std::vector<FaceId> open);

 private:
  void drain(bool with_moves);
  bool refine(FaceId f);
  bool insert_other_point(FaceId f);
  bool move(FaceId f);
  // True if an operation was done: looks at what it created, and again at what is next to that.
  bool accept(const std::optional<Refusal>& refusal);
  void enqueue_if_bad(FaceId f);
  void flip_changed();
  void follow_curves();
  bool insert_far_samples();
  void make_delaunay();
  std::vector<FaceId> not_delaunay() const;
  bool must_stop();
  void ask(FaceId f, Reason reason, double value) const {
    if (r_.observer) r_.observer->facet_asked(r_.s, f, reason, value);
  }
  bool is_live(FaceId f) const { return !is_dead(mesh_.faces[f]) && !r_.is_frozen(f); }

  Refinement& r_;
  const TriMesh& mesh_;
  std::span<const Vec3> samples_;
  std::vector<std::uint32_t>& far_;
  const bool by_count_;  // target_vertices is given
  FacetQueue queue_;
  Steps steps_;
  // Per facet: nothing is to be tried until something changes around it.
  std::vector<std::uint8_t> is_done_;
  std::vector<FaceId> refused_;    // since drain() began its turn
  std::vector<FaceId> changed_;    // to be looked at for flips
  std::vector<FaceId> at_curves_;  // and for boundary edges that leave their curve
  // Something tried for the facet at hand was refused for the sake of frozen ones: it waits until
  // the regions are put together.
  bool met_frozen_ = false;
  std::vector<FaceId> waiting_;
  bool is_full_ = false;
  double reached_ = 0;  // h of the facet last refined for the distance
};

std::vector<FaceId> RefineGeom::run(std::vector<FaceId> open) {
  Parameters& parameters = r_.parameters;
  if (by_count_) {
    parameters.refinement[Criterion::distance] = kFinestDistance * parameters.voxel;
  }
  is_done_.assign(mesh_.faces.size(), 1);
  for (const FaceId f : open) is_done_[f] = 0;
  at_curves_ = open;
  changed_.assign(open.rbegin(), open.rend());
  flip_changed();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f]) enqueue_if_bad(f);
  }
  follow_curves();
  drain(false);
  if (parameters.as_published) return {};
  while (!is_full_ && !by_count_ && insert_far_samples()) drain(false);
  drain(true);
  make_delaunay();
  return std::move(waiting_);
}

// RefineGeom, Figure 9: until every facet meets the criteria or everything is refused.
void RefineGeom::drain(bool with_moves) {
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      if (is_dead(mesh_.faces[f])) continue;
      const FacetShape shape = r_.shape(f);
      const Criterion worst = worst_criterion(shape, r_.parameters.refinement);
      ask(f, reason_of(worst), violation(shape, r_.parameters.refinement));
      if (worst == Criterion::distance && r_.s.duals[f].on_surface) reached_ = shape.h;
      if (refine(f) || (with_moves && move(f))) {
        any = true;
      } else {
        refused_.push_back(f);
        is_done_[f] = with_moves || met_frozen_;
        if (met_frozen_) waiting_.push_back(f);
      }
      follow_curves();
      steps_.step(queue_.size());
      if (must_stop()) return;
    }
    // New facets are Delaunay with each other, but need not be with those around them.
    flip_changed();
    // What was refused is tried again once its surroundings have changed.
    for (const FaceId f : std::exchange(refused_, {})) {
      if (is_live(f) && !is_done_[f]) enqueue_if_bad(f);
    }
  }
}

bool RefineGeom::refine(FaceId f) {
  met_frozen_ = false;
  if (accept(collapse_short_edge(r_, f))) return true;
  const Dual dual = r_.s.duals[f];
  if (!met_frozen_ && dual.on_surface &&
      accept(insert_point(r_, Rung::surface_point, f, dual.center))) {
    return true;
  }
  return !met_frozen_ && insert_other_point(f);
}

bool RefineGeom::move(FaceId f) {
  return !met_frozen_ && accept(move_corner(r_, f));
}

// Where the steepest lines through its circumcenter and through the middle of its longest edge meet
// Sigma.
bool RefineGeom::insert_other_point(FaceId f) {
  const Triangle v = mesh_.faces[f].v;
  const std::array<Vec3, 3> p = {r_.point(v[0]), r_.point(v[1]), r_.point(v[2])};
  std::size_t i = 0;  // the corner opposite the longest edge
  const auto length2_opposite = [&](std::size_t k) {
    return distance2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  for (const std::size_t k : {1u, 2u}) {
    if (length2_opposite(k) > length2_opposite(i)) i = k;
  }
  const Vec3 normal = area_normal(p[0], p[1], p[2]), center = circumcenter(p[0], p[1], p[2]);
  const Vec3 middle = 0.5 * (p[(i + 1) % 3] + p[(i + 2) % 3]);
  const std::array starts{std::pair{center, distance(center, p[0])},
                          std::pair{middle, 0.5 * std::sqrt(length2_opposite(i))}};
  return std::ranges::any_of(starts, [&](const auto& start) {
    const auto foot = r_.finder.foot(start.first, normal, start.second, r_.report.searches_refine);
    return foot && accept(insert_point(r_, Rung::foot, f, *foot));
  });
}

bool RefineGeom::accept(const std::optional<Refusal>& refusal) {
  met_frozen_ |= refusal == Refusal::frozen;
  if (refusal) return false;
  is_done_.resize(mesh_.faces.size(), 0);
  for (const FaceId f : r_.created()) {
    enqueue_if_bad(f);
    changed_.push_back(f);
    is_done_[f] = 0;
    for (const FaceId g : mesh_.faces[f].n) {
      if (g == kNoId) {
        at_curves_.push_back(f);
      } else {
        is_done_[g] = 0;
      }
    }
  }
  return true;
}

void RefineGeom::enqueue_if_bad(FaceId f) {
  const Triangle& v = mesh_.faces[f].v;
  queue_.set(f, r_.violation(v, r_.s.duals[f]), r_.point(v[0]));
}

// Flips edges of what changed, and then around that, until all are Delaunay or cannot be. LEG has
// needles without the flips before the queue, and all volumes 5 % more vertices without those
// after.
void RefineGeom::flip_changed() {
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    if (is_dead(mesh_.faces[f])) continue;
    ask(f, Reason::not_delaunay, std::sqrt(r_.s.duals[f].radius2));
    for (int i = 0; i < 3; ++i) {
      if (accept(flip_if_not_delaunay(r_, f, i))) break;
    }
  }
}

// Splits boundary edges that leave their curve, as facets leave Sigma.
void RefineGeom::follow_curves() {
  while (!at_curves_.empty()) {
    const FaceId f = at_curves_.back();
    at_curves_.pop_back();
    for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
      if (mesh_.faces[f].n[i] != kNoId || !leaves_curve(r_, {f, i})) continue;
      ask(f, Reason::off_curve, 0);
      if (accept(split_boundary_edge(r_, {f, i}))) break;
    }
  }
}

bool RefineGeom::insert_far_samples() {
  const double limit = kCoverage * r_.parameters.refinement[Criterion::distance];
  if (!std::isfinite(limit)) return false;
  keep_far(mesh_, r_.facets(), samples_, limit, far_);
  r_.report[Counter::points_far] = far_.size();
  bool any = false;
  for (const FarSample& at : furthest(mesh_, r_.facets(), samples_, limit, far_)) {
    if (!is_live(at.facet)) continue;  // an earlier one may have taken it away
    ask(at.facet, Reason::far_point, std::sqrt(at.distance2) / limit);
    any |= accept(insert_point(r_, Rung::far_point, at.facet, samples_[at.sample]));
    follow_curves();
  }
  return any;
}

std::vector<FaceId> RefineGeom::not_delaunay() const {
  std::vector<FaceId> found;
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f] && !r_.is_delaunay(f)) found.push_back(f);
  }
  return found;
}

void RefineGeom::make_delaunay() {
  for (int n = 0; n < kDelaunayRounds && !is_full_; ++n) {
    const std::vector<FaceId> found = not_delaunay();
    for (const FaceId f : found) {
      // An earlier one may have mended it, or taken it away.
      if (is_dead(mesh_.faces[f]) || r_.is_delaunay(f)) continue;
      ask(f, r_.s.duals[f].on_surface ? Reason::not_delaunay : Reason::no_surface_point,
          std::sqrt(r_.s.duals[f].radius2));
      const bool is_small = r_.shape(f).r <= kSmallForDelaunay * r_.parameters.r_min;
      met_frozen_ = false;
      if ((is_small || !refine(f)) && !move(f)) is_done_[f] = 1;
      if (met_frozen_) waiting_.push_back(f);
    }
    drain(true);
  }
}

// True at max_vertices. At target_vertices what was reached becomes the bound on the distance, and
// only shape is refined from there on.
bool RefineGeom::must_stop() {
  const Parameters& parameters = r_.parameters;
  const std::size_t vertices = mesh_.points.size();
  if (vertices >= parameters.max_vertices) {
    if (!parameters.keep_partial) {
      throw InputError("more than --max-vertices " + std::to_string(parameters.max_vertices) +
                       " vertices needed");
    }
    r_.report.stopped_at_max_vertices = is_full_ = true;
    return true;
  }
  if (vertices < parameters.target_vertices || is_full_) return false;
  is_full_ = true;
  double& bound = r_.parameters.refinement[Criterion::distance];
  double largest = bound;
  for (FaceId f = 0; f < mesh_.faces.size() && reached_ == 0; ++f) {
    // Without a surface point h is r, and a needle's r may be anything.
    if (is_live(f) && r_.s.duals[f].on_surface) largest = std::max(largest, r_.shape(f).h);
  }
  bound = reached_ > 0 ? reached_ : largest;
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f)) enqueue_if_bad(f);
  }
  return false;
}

}  // namespace

std::vector<FaceId> refine_geom(Refinement& refinement, std::vector<FaceId> open,
                                std::span<const Vec3> samples, std::vector<std::uint32_t>& far) {
  return RefineGeom(refinement, samples, far).run(std::move(open));
}

}  // namespace deliso
