// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "base/triangle.h"
#include "refine/coarsen.h"
#include "refine/coverage.h"
#include "refine/facet_queue.h"
#include "refine/operations.h"
#include "refine/regions.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// Largest distance from a reference sample to the mesh, in bounds on h. With 1, meshes have 40 %
// more vertices (docs/decisions.md).
constexpr double kCoverageDistances = 2;

// A mesh of a desired size is coarsened from one of this many times as many vertices or triangles.
// From 1.2 times as many, distances are a tenth larger; from twice as many, a tenth smaller in 1.8
// times the time (ENGINE and LEG, 20,000 to 100,000 vertices).
constexpr double kFinerRatio = 1.5;

// The first and the last bound on the distance for such a mesh, and the ratio of each to the one
// before.
constexpr double kFirstDistanceVoxels = 0.4, kLastDistanceVoxels = 2e-3, kDistanceRatio = 0.7;

// The violation of a facet that meets the criteria and is not Delaunay: the last in the queue.
constexpr double kLastInQueue = 1.0001;

// Larger facets are refined if they are not Delaunay; of smaller ones only corners are moved.
// Between sheets that nearly touch, insertions would not end.
constexpr double kMinDelaunayRMins = 0.5;

// Largest circumradius, in longest edges, of a facet near whose circumcenter a point is inserted.
// The circumcenter of a flatter one is far from all of the mesh around it, and the point may be on
// another component. Of 5,000 random volumes two got such a vertex; 2 to 6 mend both, 10 only one.
// With 6 none of 17 fields and volumes changes.
constexpr double kMaxRadiusEdges = 6;

// Rounds in which facets are made Delaunay. The first tests all facets, the next those near a
// change: a new vertex may be in the balls of other facets. A third round changes nothing.
constexpr int kDelaunayRounds = 2;

// RefineGeom of Figure 9, for a mesh or a region: one queue, the worst first.
class RefineGeom {
 public:
  // `far`: the numbers of samples that may be too far from the mesh; run() removes the others.
  RefineGeom(Refinement& refinement, std::span<const Vec3> samples, std::vector<std::uint32_t>& far)
      : r_(refinement),
        mesh_(refinement.mesh),
        samples_(samples),
        far_(far),
        queue_(refinement.parameters.voxel),
        steps_(refinement.parameters.observer) {}

  // Refines the facets that are not done, and new ones. Returns the facets with deferred
  // operations. Throws InputError at max_vertices unless keep_partial.
  std::vector<FaceId> run(std::vector<std::uint8_t> is_done);

 private:
  void drain(bool with_moves);
  bool refine(FaceId f);
  bool insert_other_point(FaceId f, bool is_near);
  // True if f's circumcenter is near f, so that a point near the one is near the other.
  bool is_center_near(FaceId f) const;
  bool move(FaceId f) { return !met_frozen_ && accept(move_corner(r_, f)); }
  // Returns true if an operation was done. Then it queues the facets created, and marks them and
  // their neighbors as not done.
  bool accept(const std::optional<Refusal>& refusal);
  // Queues f if it violates a criterion or `at_least` is over 1.
  void enqueue(FaceId f, double at_least = 0);
  // Returns why f must be refined; nullopt if it need not.
  std::optional<Reason> fault(FaceId f) const;
  // Returns the side of f that is too far from its boundary curve; 3: none.
  int side_off_curve(FaceId f) const;
  void flip_changed();
  bool insert_far_samples();
  void make_delaunay();
  bool must_stop();
  // Reports f to the observer, with the violation of the criterion, else f's circumradius.
  void ask(FaceId f, Reason reason) const {
    if (!r_.observer) return;
    const FacetShape s = r_.shape(f);
    const double over = violation(s, r_.parameters.refinement);
    r_.observer->facet_asked(r_.s, f, reason, reason < Reason::count_ ? s.r : over);
  }
  bool is_live(FaceId f) const { return !is_dead(mesh_.faces[f]) && !r_.is_frozen(f); }

  Refinement& r_;
  const TriMesh& mesh_;
  std::span<const Vec3> samples_;
  std::vector<std::uint32_t>& far_;
  FacetQueue queue_;
  Steps steps_;
  // Per facet: no operation is tried until a facet near it changes.
  std::vector<std::uint8_t> is_done_;
  std::vector<FaceId> refused_;  // in this pass of drain()
  std::vector<FaceId> changed_;  // to be tested for flips
  // An operation for this facet was refused because of a frozen facet. It is deferred until the
  // regions are merged.
  bool met_frozen_ = false;
  std::vector<FaceId> deferred_;
  bool is_full_ = false;
};

std::vector<FaceId> RefineGeom::run(std::vector<std::uint8_t> is_done) {
  is_done_ = std::move(is_done);
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f]) changed_.push_back(f);
  }
  std::ranges::reverse(changed_);  // flip_changed() begins at the end
  flip_changed();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f]) enqueue(f);
  }
  drain(false);
  if (r_.parameters.as_published) return {};
  while (!is_full_ && insert_far_samples()) drain(false);
  drain(true);
  for (int n = 0; n < kDelaunayRounds && !is_full_; ++n) make_delaunay();
  return std::move(deferred_);
}

// Refines until every facet meets the criteria or every operation is refused.
void RefineGeom::drain(bool with_moves) {
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      const auto reason = is_dead(mesh_.faces[f]) ? std::nullopt : fault(f);
      if (!reason) continue;  // removed, or good since an operation near it
      if (must_stop()) return;
      ask(f, *reason);
      if (refine(f) || (with_moves && move(f))) {
        any = true;
      } else {
        refused_.push_back(f);
        is_done_[f] = with_moves || met_frozen_;
        if (met_frozen_) deferred_.push_back(f);
      }
      steps_.step(queue_.size());
    }
    // An edge between a new facet and an old one need not be Delaunay.
    flip_changed();
    // Refused facets are tried again; in the next pass their surroundings may have changed.
    for (const FaceId f : std::exchange(refused_, {})) {
      if (is_live(f) && !is_done_[f]) enqueue(f);
    }
  }
}

bool RefineGeom::refine(FaceId f) {
  met_frozen_ = false;
  const FacetShape shape = r_.shape(f);
  const int side = side_off_curve(f);
  if (side == 3 && violation(shape, r_.parameters.refinement) <= 1 &&
      shape.r <= kMinDelaunayRMins * r_.parameters.r_min) {
    return false;
  }
  const Dual dual = r_.s.duals[f];
  const bool is_near = is_center_near(f);
  return (side < 3 && accept(split_boundary_edge(r_, {f, side}))) ||
         accept(collapse_short_edge(r_, f)) ||
         (!met_frozen_ && dual.on_surface && is_near &&
          accept(insert_point(r_, Operation::surface_point, f, dual.center))) ||
         (!met_frozen_ && insert_other_point(f, is_near));
}

bool RefineGeom::is_center_near(FaceId f) const {
  if (r_.parameters.as_published) return true;
  const Triangle& v = mesh_.faces[f].v;
  const double longest2 = longest_edge2(r_.point(v[0]), r_.point(v[1]), r_.point(v[2]));
  return r_.shape(f).r <= kMaxRadiusEdges * std::sqrt(longest2);
}

// Inserts the foot of the circumcenter of f or, if that is far or refused, of its longest edge's
// middle.
bool RefineGeom::insert_other_point(FaceId f, bool is_near) {
  const Triangle v = mesh_.faces[f].v;
  const std::array<Vec3, 3> p{r_.point(v[0]), r_.point(v[1]), r_.point(v[2])};
  const auto length2 = [&](std::size_t i) { return distance2(p[(i + 1) % 3], p[(i + 2) % 3]); };
  const std::size_t i =
      std::max({0u, 1u, 2u}, [&](unsigned a, unsigned b) { return length2(a) < length2(b); });
  const Vec3 normal = r_.normal(v), center = circumcenter(p[0], p[1], p[2]);
  const Vec3 middle = 0.5 * (p[(i + 1) % 3] + p[(i + 2) % 3]);
  const auto insert_foot = [&](const Vec3& from, double limit) {
    const auto foot = r_.finder.foot(from, normal, limit, r_.report.searches_refine);
    return foot && accept(insert_point(r_, Operation::foot, f, *foot));
  };
  return (is_near && insert_foot(center, distance(center, p[0]))) ||
         insert_foot(middle, 0.5 * std::sqrt(length2(i)));
}

bool RefineGeom::accept(const std::optional<Refusal>& refusal) {
  met_frozen_ |= refusal == Refusal::frozen;
  if (refusal) return false;
  is_done_.resize(mesh_.faces.size(), 0);
  for (const FaceId f : r_.created()) {
    enqueue(f);
    changed_.push_back(f);
    is_done_[f] = 0;
    for (const FaceId g : mesh_.faces[f].n) {
      if (g != kNoId) is_done_[g] = 0;
    }
  }
  return true;
}

void RefineGeom::enqueue(FaceId f, double at_least) {
  const Triangle& v = mesh_.faces[f].v;
  const double violation =
      side_off_curve(f) < 3 ? kNotAsked : std::max(at_least, r_.violation(v, r_.s.duals[f]));
  queue_.set(f, violation, r_.point(v[0]));
}

std::optional<Reason> RefineGeom::fault(FaceId f) const {
  if (side_off_curve(f) < 3) return Reason::off_curve;
  const FacetShape shape = r_.shape(f);
  const Criteria& criteria = r_.parameters.refinement;
  if (violation(shape, criteria) > 1) return reason_of(worst_criterion(shape, criteria));
  if (!r_.s.duals[f].on_surface) return Reason::no_surface_point;
  return r_.is_delaunay(f) ? std::nullopt : std::optional(Reason::not_delaunay);
}

int RefineGeom::side_off_curve(FaceId f) const {
  const auto& across = mesh_.faces[f].n;
  int side = 0;
  while (side < 3 && (across[side] != kNoId || !leaves_curve(r_, {f, side}))) ++side;
  return side;
}

// Flips edges of changed facets, and of the facets that flips change, until no flip is done.
// Without the flips before the queue LEG has needles. Without those after it all volumes have 5 %
// more vertices.
void RefineGeom::flip_changed() {
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    if (is_dead(mesh_.faces[f])) continue;
    ask(f, Reason::not_delaunay);
    for (int i = 0; i < 3; ++i) {
      if (accept(flip_if_not_delaunay(r_, f, i))) break;
    }
  }
}

bool RefineGeom::insert_far_samples() {
  const double limit = kCoverageDistances * r_.parameters.refinement[Criterion::distance];
  if (!std::isfinite(limit)) return false;
  const auto far = find_far(mesh_, r_.facets(), samples_, limit, far_);
  r_.report[Counter::points_far] = far_.size();
  bool any = false;
  for (const FarSample& at : far) {
    if (!is_live(at.facet)) continue;  // an earlier insertion may have removed it
    if (must_stop()) break;
    ask(at.facet, Reason::far_point);
    any |= accept(insert_point(r_, Operation::far_point, at.facet, samples_[at.sample]));
  }
  return any;
}

void RefineGeom::make_delaunay() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (!is_live(f) || is_done_[f]) continue;
    if (fault(f)) {
      enqueue(f, kLastInQueue);
    } else {
      is_done_[f] = 1;
    }
  }
  drain(true);
}

// Returns true at max_vertices.
bool RefineGeom::must_stop() {
  const Parameters& parameters = r_.parameters;
  if (mesh_.points.size() < parameters.max_vertices) return false;
  if (!parameters.keep_partial) {
    throw InputError("more than --max-vertices " + std::to_string(parameters.max_vertices) +
                     " vertices needed");
  }
  r_.report.stopped_at_max_vertices = is_full_ = true;
  return true;
}

// True if the mesh may be cut into regions. A refinement that may end early, the paper's, and one
// that is observed take the worst facet of the whole mesh first.
bool may_be_cut(const Parameters& p) {
  return !p.as_published && !p.keep_partial && !(p.observer && p.observer->follows_insertions());
}

// Refines the mesh region by region. Returns which facets are done. Removes from `far` the samples
// that only one region can be near, and adds again the ones that stay too far.
std::vector<std::uint8_t> refine_regions(SurfaceMesh& mesh, const Isosurface& surface,
                                         const BoundaryCurves& curves,
                                         std::span<const Vec3> samples,
                                         const Parameters& parameters, std::size_t largest_region,
                                         std::vector<std::uint32_t>& far, Report& report) {
  begin_stage(parameters.observer, "regions");
  const double margin = kCoverageDistances * parameters.refinement[Criterion::distance];
  auto regions = cut_into_regions(mesh, largest_region, samples, margin, far);
  std::vector<std::vector<FaceId>> deferred(regions.size());
  std::vector<Report> reports(regions.size());
  Parameters unobserved = parameters;
  unobserved.observer = nullptr;
  std::mutex mutex;
  std::size_t done = 0;
  for_each_task(parameters.threads, regions.size(), [&](std::size_t n) {
    MeshRegion& region = regions[n];
    extract(mesh, region);
    Refinement refinement(region.surface, surface, curves, unobserved, reports[n], region.box);
    deferred[n] = RefineGeom(refinement, samples, region.samples)
                      .run(std::vector<std::uint8_t>(region.facets.size(), 0));
    const std::lock_guard lock(mutex);
    ++done;
    if (parameters.observer) parameters.observer->steps_done(done, regions.size() - done);
  });
  std::vector<std::uint8_t> is_done(mesh.mesh.faces.size(), 0);
  for (std::size_t n = 0; n < regions.size(); ++n) {
    const MeshRegion region = std::move(regions[n]);
    const std::vector<FaceId> numbers = put_back(mesh, region);
    is_done.resize(mesh.mesh.faces.size(), 0);
    // A facet whose surface ball leaves the region's box is refined again.
    for (FaceId f = region.box.first_free; f < numbers.size(); ++f) {
      const Dual& dual = region.surface.duals[f];
      is_done[numbers[f]] = region.box.holds(dual.center, std::sqrt(dual.radius2));
    }
    for (const FaceId f : deferred[n]) is_done[numbers[f]] = 0;
    far.insert(far.end(), region.samples.begin(), region.samples.end());
    report.add_refinement(reports[n]);
  }
  link_faces(mesh.mesh);
  return is_done;
}

void count_unrefined(const Refinement& r) {
  std::uint64_t over_limit = 0;
  r.report.largest_h = 0;
  for (FaceId f = 0; f < r.mesh.faces.size(); ++f) {
    if (is_dead(r.mesh.faces[f])) continue;
    const FacetShape s = r.shape(f);
    if (s.r > r.parameters.r_min) r.report.largest_h = std::max(r.report.largest_h, s.h);
    over_limit += violation(s, r.parameters.refinement) > 1;
  }
  r.report[Counter::unrefined_facets] = over_limit;
  r.report.max_distance = r.parameters.refinement[Criterion::distance];
}

// How far the sample is from the mesh that is furthest from it.
double furthest_sample(const Refinement& r, std::span<const Vec3> samples) {
  for (double limit = 4 * r.parameters.voxel; limit > 1e-6 * r.parameters.voxel; limit /= 2) {
    std::vector<std::uint32_t> numbers(samples.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const auto far = find_far(r.mesh, r.facets(), samples, limit, numbers);
    if (!far.empty()) return std::sqrt(far[0].distance2);
  }
  return 0;
}

// Refines until every facet meets the criteria or everything is refused. Dead facets stay.
void refine_to_limits(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                      std::vector<Vec3> samples, const Parameters& parameters, Report& report,
                      std::size_t largest_region) {
  std::vector<std::uint32_t> far(samples.size());
  std::iota(far.begin(), far.end(), 0);
  std::vector<std::uint8_t> is_done(mesh.mesh.faces.size(), 0);
  if (may_be_cut(parameters)) {
    is_done =
        refine_regions(mesh, surface, curves, samples, parameters, largest_region, far, report);
    std::vector<Vec3> left;
    for (std::uint32_t& n : far) {
      left.push_back(samples[n]);
      n = static_cast<std::uint32_t>(left.size() - 1);
    }
    samples = std::move(left);
  }
  if (!parameters.has_target()) begin_stage(parameters.observer, "refine");
  Refinement whole(mesh, surface, curves, parameters, report);
  RefineGeom(whole, samples, far).run(std::move(is_done));
  count_unrefined(whole);
}

std::size_t live_facets(const TriMesh& mesh) {
  return static_cast<std::size_t>(
      std::ranges::count_if(mesh.faces, [](const Face& face) { return !is_dead(face); }));
}

// Refines to more vertices or triangles than are desired, by bounds on the distance that shrink,
// and coarsens. Only an observer that follows insertions is told of the stages in between.
void refine_to_count(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                     std::span<const Vec3> samples, const Parameters& given, Report& report,
                     std::size_t largest_region) {
  begin_stage(given.observer, "refine");
  Parameters parameters = given;
  parameters.observer = follower(given.observer);
  parameters.max_vertices = Parameters::kNoTarget;
  const bool by_triangles = given.target_triangles != Parameters::kNoTarget;
  const std::size_t target = by_triangles ? given.target_triangles : given.target_vertices;
  const auto wanted = static_cast<std::size_t>(kFinerRatio * static_cast<double>(target));
  const auto count_now = [&] {
    return by_triangles ? live_facets(mesh.mesh) : mesh.mesh.points.size();
  };
  double& bound = parameters.refinement[Criterion::distance];
  bound = kFirstDistanceVoxels * given.voxel;
  std::size_t count = 0;
  for (; bound > kLastDistanceVoxels * given.voxel && count < wanted; bound *= kDistanceRatio) {
    refine_to_limits(mesh, surface, curves, {samples.begin(), samples.end()}, parameters, report,
                     largest_region);
    if (may_be_cut(parameters)) remove_dead(mesh);
    if (count_now() > std::exchange(count, count_now()) && given.observer) {
      given.observer->steps_done(count, wanted - std::min(wanted, count));
    }
  }
  bound = kNotAsked;
  begin_stage(given.observer, "coarsen");
  parameters.observer = given.observer;
  Refinement whole(mesh, surface, curves, parameters, report);
  coarsen(whole, given.target_vertices, given.target_triangles);
  count_unrefined(whole);
  report.max_distance = furthest_sample(whole, samples);
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::vector<Vec3> samples, const Parameters& parameters, Report& report,
            std::size_t largest_region) {
  const StepTimer timer(report.seconds_refine);
  if (!parameters.has_target()) {
    refine_to_limits(mesh, surface, curves, std::move(samples), parameters, report, largest_region);
  } else {
    refine_to_count(mesh, surface, curves, samples, parameters, report, largest_region);
  }
  remove_dead(mesh);
  report.vertices_refined = mesh.mesh.points.size();
  report.triangles_refined = mesh.mesh.faces.size();
}

}  // namespace deliso
