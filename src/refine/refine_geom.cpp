// SPDX-License-Identifier: MIT
#include "refine/refine_geom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "refine/collapse.h"
#include "refine/flip.h"
#include "refine/insert.h"
#include "refine/judge.h"
#include "refine/move.h"
#include "refine/reach.h"
#include "refine/replace_disk.h"
#include "refine/retriangulate.h"
#include "refine/worst_first.h"
#include "surface/stage_progress.h"

namespace deliso {
namespace {

// A bound on the distance that no mesh of so many vertices keeps: what --vertices begins with.
constexpr double kFinest = 2e-3;  // voxels

// Facets that are wanted Delaunay though they meet the criteria: those above this share of r_min
// are refined for it, smaller ones only rearranged.
constexpr double kSmall = 0.5;

// How often all facets are looked at for that, since what is inserted for some is in the balls of
// others, and to what share their number must fall each time: between sheets that all but touch it
// would grow.
constexpr int kRounds = 3;
constexpr double kFewer = 0.5;

// The queue's blocks, in voxels: what a facet and its surroundings take of mesh and volume stays in
// the cache.
constexpr double kBlock = 32;
// How wide its bands are, in fourths of an octave. Where the refinement may end before all is done,
// what is worst anywhere comes first.
constexpr unsigned kBand = 8, kNarrowBand = 1;

// What refining takes of the time, and what the points of Sigma that are too far take of the rest;
// the dear rungs take what is left. Typical of the paper's volumes.
constexpr double kRefining = 0.7, kReaching = 0.5;

class Refiner {
 public:
  Refiner(SurfaceMesh& surface_mesh, const Isosurface& surface, const BoundaryCurves& curves,
          const Parameters& parameters, Work& work, StageProgress& progress, Report& report)
      : s_(surface_mesh),
        mesh_(surface_mesh.mesh),
        parameters_(parameters),
        trace_(parameters.trace),
        progress_(progress),
        report_(report),
        work_(work),
        replacer_(surface_mesh, surface, parameters_, report, work.part),
        judge_(surface_mesh, replacer_, parameters_),
        inserter_(surface_mesh, replacer_, curves, parameters_, report),
        flipper_(surface_mesh, replacer_),
        collapser_(surface_mesh, replacer_, judge_, surface, curves, parameters_, work.of_stage1),
        retriangulator_(surface_mesh, replacer_, report),
        mover_(surface_mesh, replacer_, judge_, parameters_, report),
        by_count_(parameters.target_vertices != std::numeric_limits<std::size_t>::max()),
        queue_(surface.volume().box(), kBlock * parameters.voxel, by_count_ ? kNarrowBand : kBand),
        settled_(work.settled) {}

  void run(std::span<const Vec3> witnesses);

 private:
  // Which rungs are tried: the dear ones only where the cheap ones have left something.
  enum class Rungs { cheap, all };

  // RefineGeom, Figure 9: until every facet meets the criteria or every rung is refused.
  void refine_geom(Rungs rungs);
  // Inserts witnesses that are too far from the mesh; whether any.
  bool reach(std::span<const Vec3> witnesses);
  // Makes facets Delaunay whose balls hold vertices, or that have no surface point.
  void make_delaunay();
  std::vector<FaceId> not_delaunay() const;  // but for the stuck ones
  void count_left();
  void hand_back();

  FacetShape shape(FaceId f) const;
  void queue_if_bad(FaceId f);
  void queue_all_bad();
  // New facets: judged, and looked at for flips and for leaving the boundary's curve.
  bool take(std::span<const FaceId> created);
  bool climb(FaceId f, Rungs rungs);
  // What is tried for one facet needs another part: it waits until the parts are put together.
  bool is_put_off() const { return replacer_.refused_beyond() != beyond_before_; }
  void settle(FaceId f, Rungs rungs);
  bool refine(FaceId f);
  bool rearrange(FaceId f);
  std::array<std::optional<Vec3>, 2> other_points(FaceId f);
  void legalize();
  void follow_curves();
  // Whether to stop, at max_vertices; at target_vertices it fixes the bound on the distance, so
  // that only shape is refined from there on.
  bool must_stop();
  void show_progress();

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  Parameters parameters_;  // its bound on the distance gives way to target_vertices
  Trace* trace_;
  StageProgress& progress_;
  Report& report_;
  Work& work_;
  DiskReplacer replacer_;
  Judge judge_;
  Inserter inserter_;
  Flipper flipper_;
  Collapser collapser_;
  Retriangulator retriangulator_;
  Mover mover_;

  bool by_count_;  // --vertices
  WorstFirst queue_;
  std::vector<FaceId> refused_;
  // Per facet: nothing is to be tried until something changes around it, since there is nothing to
  // do or every rung was refused; kPutOff: refused for the sake of what is not of this part.
  static constexpr std::uint8_t kSettled = 1, kPutOff = 2;
  std::vector<std::uint8_t>& settled_;
  std::vector<FaceId> changed_;  // since legalize() last looked at them
  std::vector<FaceId> ends_;     // facets whose boundary edges are to be looked at
  std::size_t rearrangements_left_ = 0;
  std::size_t beyond_before_ = 0;
  bool full_ = false;
  double reached_ = 0;  // h of the facet last taken from the queue
};

void Refiner::run(std::span<const Vec3> witnesses) {
  if (by_count_) parameters_.refinement[Criterion::distance] = kFinest * parameters_.voxel;
  for (FaceId f = static_cast<FaceId>(mesh_.faces.size()); f-- > work_.part.first;) {
    if (!is_dead(mesh_.faces[f]) && !settled_[f]) changed_.push_back(f);
  }
  ends_ = changed_;
  legalize();
  queue_all_bad();
  follow_curves();
  progress_.begin_part_of_rest(parameters_.as_published ? 1 : kRefining);
  refine_geom(Rungs::cheap);
  if (!parameters_.as_published) {
    progress_.begin_part_of_rest(kReaching);
    while (!full_ && !by_count_ && reach(witnesses)) refine_geom(Rungs::cheap);
    progress_.begin_part_of_rest(1);
    rearrangements_left_ = mesh_.faces.size();
    refine_geom(Rungs::all);
    make_delaunay();
  }
  work_.part.is_whole() ? count_left() : hand_back();
}

FacetShape Refiner::shape(FaceId f) const {
  return judge_.shape(mesh_.faces[f].v, s_.duals[f]);
}

void Refiner::queue_if_bad(FaceId f) {
  const Triangle& v = mesh_.faces[f].v;
  queue_.set(f, judge_.violation(v, s_.duals[f]), mesh_.points[v[0]]);
}

void Refiner::queue_all_bad() {
  for (FaceId f = work_.part.first; f < mesh_.faces.size(); ++f) {
    if (!is_dead(mesh_.faces[f]) && !settled_[f]) queue_if_bad(f);
  }
}

bool Refiner::take(std::span<const FaceId> created) {
  settled_.resize(mesh_.faces.size(), 0);
  for (const FaceId f : created) {
    queue_if_bad(f);
    changed_.push_back(f);
    settled_[f] = 0;
    for (const FaceId g : mesh_.faces[f].n) {
      if (g == kNoId) {
        ends_.push_back(f);
      } else {
        settled_[g] = 0;
      }
    }
  }
  return true;
}

void Refiner::refine_geom(Rungs rungs) {
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      if (is_dead(mesh_.faces[f])) continue;
      if (trace_) trace_criteria(*trace_, s_, f, shape(f), parameters_.refinement);
      if (by_count_ && s_.duals[f].on_surface) reached_ = shape(f).h;
      if (climb(f, rungs)) {
        any = true;
      } else {
        refused_.push_back(f);
      }
      follow_curves();
      show_progress();
      if (must_stop()) return;
    }
    // New facets are Delaunay with each other, but need not be with those beyond their rim.
    legalize();
    // What was refused is tried again once its surroundings have changed.
    for (const FaceId f : std::exchange(refused_, {})) {
      if (!is_dead(mesh_.faces[f]) && !settled_[f]) queue_if_bad(f);
    }
  }
}

bool Refiner::must_stop() {
  const std::size_t vertices = mesh_.points.size();
  if (vertices >= parameters_.max_vertices) {
    if (!parameters_.keep_partial) {
      throw InputError("more than --max-vertices " + std::to_string(parameters_.max_vertices) +
                       " vertices needed");
    }
    report_.stopped_at_max_vertices = full_ = true;
    return true;
  }
  if (vertices < parameters_.target_vertices || full_) return false;
  // The rest is for shape alone: what the worst facet has now is the bound on the distance.
  full_ = true;
  double largest = 0;
  for (FaceId f = 0; f < mesh_.faces.size() && reached_ == 0; ++f) {
    if (!is_dead(mesh_.faces[f])) largest = std::max(largest, shape(f).h);
  }
  parameters_.refinement[Criterion::distance] = reached_ > 0 ? reached_ : largest;
  queue_all_bad();
  return false;
}

bool Refiner::reach(std::span<const Vec3> witnesses) {
  const double limit = kReach * parameters_.refinement[Criterion::distance];
  if (!std::isfinite(limit)) return false;
  keep_far(mesh_, replacer_.facets(), witnesses, limit, work_.far);
  report_[Counter::points_far] = work_.far.size();
  bool any = false;
  for (const FarPoint& at : furthest(mesh_, replacer_.facets(), witnesses, limit, work_.far)) {
    const Vec3& p = witnesses[at.witness];
    // An earlier one may have taken its facet away.
    if (is_dead(mesh_.faces[at.facet]) || replacer_.is_fixed(at.facet)) continue;
    if (trace_) {
      trace_facet(*trace_, s_, at.facet, trace_code(Reason::far_point),
                  std::sqrt(at.distance2) / limit);
    }
    if (inserter_.insert(Rung::far_point, at.facet, p)) any = take(inserter_.created());
    follow_curves();
  }
  return any;
}

std::vector<FaceId> Refiner::not_delaunay() const {
  std::vector<FaceId> found;
  for (FaceId f = work_.part.first; f < mesh_.faces.size(); ++f) {
    if (!is_dead(mesh_.faces[f]) && !settled_[f] && !replacer_.is_delaunay(f)) found.push_back(f);
  }
  return found;
}

void Refiner::make_delaunay() {
  double allowed = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kRounds && !full_; ++n) {
    const std::vector<FaceId> found = not_delaunay();
    if (found.empty() || static_cast<double>(found.size()) > allowed) return;
    allowed = kFewer * static_cast<double>(found.size());
    for (const FaceId f : found) {
      // An earlier one may have mended it, or taken it away.
      if (is_dead(mesh_.faces[f]) || replacer_.is_delaunay(f)) continue;
      if (trace_) trace_not_delaunay(*trace_, s_, f);
      const bool is_small = shape(f).r <= kSmall * parameters_.r_min;
      beyond_before_ = replacer_.refused_beyond();
      const bool mended = (!is_small && refine(f)) || (!is_put_off() && rearrange(f));
      if (!mended) settle(f, Rungs::all);
    }
    refine_geom(Rungs::all);
  }
}

void Refiner::show_progress() {
  // As long as there is room for more vertices, they tell better what is done than the queue.
  if (by_count_ && !full_) {
    progress_.reach(static_cast<double>(mesh_.points.size()) /
                    static_cast<double>(parameters_.target_vertices));
  } else {
    progress_.step(queue_.size());
  }
}

bool Refiner::climb(FaceId f, Rungs rungs) {
  beyond_before_ = replacer_.refused_beyond();
  if (refine(f) || (rungs == Rungs::all && !is_put_off() && rearrange(f))) return true;
  settle(f, rungs);
  return false;
}

void Refiner::settle(FaceId f, Rungs rungs) {
  if (is_put_off()) {
    settled_[f] = kPutOff;
  } else if (rungs == Rungs::all) {
    settled_[f] = kSettled;
  }
}

// The cheap rungs.
bool Refiner::refine(FaceId f) {
  if (collapser_.collapse(f)) return take(collapser_.created());
  if (is_put_off()) return false;
  const Dual dual = s_.duals[f];
  if (dual.on_surface && inserter_.insert(Rung::surface_point, f, dual.center)) {
    return take(inserter_.created());
  }
  if (is_put_off()) return false;
  for (const std::optional<Vec3>& p : other_points(f)) {
    if (p && inserter_.insert(Rung::foot, f, *p)) return take(inserter_.created());
  }
  if (is_put_off()) return false;
  // Next to the boundary a shorter boundary edge makes room, unless it is short already.
  for (int i = 0; i < 3; ++i) {
    if (mesh_.faces[f].n[i] != kNoId) continue;
    const Triangle& v = mesh_.faces[f].v;
    const Vec3 &a = mesh_.points[v[(i + 1) % 3]], &b = mesh_.points[v[(i + 2) % 3]];
    if (distance(a, b) >= shape(f).r && inserter_.split_boundary({f, i})) {
      return take(inserter_.created());
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (flipper_.flip_if_not_delaunay(f, i)) return take(flipper_.created());
  }
  return false;
}

// The dear ones. Each lowers something of its own, but all together, and flips, could go round in
// circles: so many are tried.
bool Refiner::rearrange(FaceId f) {
  if (rearrangements_left_ == 0) return false;
  --rearrangements_left_;
  if (retriangulator_.retriangulate(f)) return take(retriangulator_.created());
  if (collapser_.take_out_corner(f)) return take(collapser_.created());
  return mover_.move_corner(f) && take(mover_.created());
}

// Where the steepest lines through its circumcenter and through the middle of its longest edge meet
// Sigma.
std::array<std::optional<Vec3>, 2> Refiner::other_points(FaceId f) {
  const Triangle& v = mesh_.faces[f].v;
  const std::array<Vec3, 3> p = {mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]};
  const Vec3 normal = area_normal(p[0], p[1], p[2]), center = circumcenter(p[0], p[1], p[2]);
  std::size_t i = 0;  // the corner opposite the longest edge
  const auto length2_opposite = [&](std::size_t k) {
    return distance2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  for (const std::size_t k : {1u, 2u}) {
    if (length2_opposite(k) > length2_opposite(i)) i = k;
  }
  const Vec3 middle = 0.5 * (p[(i + 1) % 3] + p[(i + 2) % 3]);
  SearchCounters& counters = report_.searches_refine;
  SurfacePointFinder& finder = replacer_.finder();
  return {finder.foot(center, normal, distance(center, p[0]), counters),
          finder.foot(middle, normal, 0.5 * std::sqrt(length2_opposite(i)), counters)};
}

// Flips edges of what changed, and then around that, until all are Delaunay or cannot be.
void Refiner::legalize() {
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    if (trace_ && !is_dead(mesh_.faces[f])) trace_not_delaunay(*trace_, s_, f);
    for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
      if (!flipper_.flip_if_not_delaunay(f, i)) continue;
      take(flipper_.created());
      break;
    }
  }
}

// Splits the boundary edges of the facets in ends_ that leave their curve, as facets leave Sigma.
void Refiner::follow_curves() {
  while (!ends_.empty()) {
    const FaceId f = ends_.back();
    ends_.pop_back();
    for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
      if (mesh_.faces[f].n[i] != kNoId || !inserter_.leaves_curve({f, i})) continue;
      if (trace_) trace_off_curve(*trace_, s_, f, i);
      if (!inserter_.split_boundary({f, i})) continue;
      take(inserter_.created());
      break;
    }
  }
}

void Refiner::count_left() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_dead(mesh_.faces[f])) continue;
    const FacetShape s = shape(f);
    if (s.r > parameters_.r_min) report_.largest_h = std::max(report_.largest_h, s.h);
    report_[Counter::unrefined_facets] += judge_.violation(mesh_.faces[f].v, s_.duals[f]) > 1;
  }
  report_.max_distance = parameters_.refinement[Criterion::distance];
}

// Nothing more is to be done for the facets of the part but where something was put off, or where
// more may be in their balls than is seen here.
void Refiner::hand_back() {
  settled_.resize(mesh_.faces.size(), 0);
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    const Dual& dual = s_.duals[f];
    settled_[f] = !replacer_.is_fixed(f) && settled_[f] != kPutOff &&
                  work_.part.holds(dual.center, std::sqrt(dual.radius2));
  }
}

}  // namespace

void refine_geom(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                 std::span<const Vec3> witnesses, const Parameters& parameters, Work& work,
                 StageProgress& progress, Report& report) {
  Refiner(mesh, surface, curves, parameters, work, progress, report).run(witnesses);
}

}  // namespace deliso
