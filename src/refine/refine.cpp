// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/stopwatch.h"
#include "base/triangle.h"
#include "refine/coverage.h"
#include "refine/facet_queue.h"
#include "refine/operations.h"
#include "refine/separate.h"
#include "refine/thin.h"

namespace deliso {
namespace {

// The violation of a facet that meets the criteria and is not Delaunay: the last in the queue.
constexpr double kLastInQueue = 1.0001;

// Larger facets are refined if they are not Delaunay; of smaller ones only corners are moved.
// Between sheets that nearly touch, insertions would not end.
constexpr double kMinDelaunayRMins = 0.5;

// Largest circumradius, in longest edges, of a facet near whose circumcenter a point is inserted.
// That of a flatter one is far from all of the mesh around it, and so may the point be, though its
// sheet leads there. Two of 5,000 random volumes got such a vertex. With 2 they do not, with 6 one
// does.
constexpr double kMaxRadiusEdges = 2;

// Rounds in which facets are made Delaunay. The first tests all facets, the next those near a
// change: a new vertex may be in the balls of other facets. A third round changes nothing.
constexpr int kDelaunayRounds = 2;

// RefineGeom of Figure 9: one queue, the worst first.
class RefineGeom {
 public:
  // `far`: the numbers of samples that may be too far from the mesh; run() removes the others.
  RefineGeom(Refinement& refinement, std::span<const Vec3> samples, std::vector<std::uint32_t>& far)
      : r_(refinement),
        mesh_(refinement.mesh),
        samples_(samples),
        far_(far),
        steps_(refinement.parameters.observer) {}

  // Refines the facets that are not done, and new ones; then thins the vertices near a change.
  // Returns per facet whether it is done; one at which a frozen facet refused an operation is not.
  // Throws InputError at max_vertices.
  std::vector<std::uint8_t> run(std::vector<std::uint8_t> is_done, bool thins);

 private:
  void thin();
  enum class Moves : std::uint8_t { no, yes };
  // Refines until every facet meets the criteria or every operation is refused. The last operation
  // is a move, if moves are allowed.
  void refine_worst_first(Moves moves);
  // Tries the operations on a facet, the cheapest first, until one is done.
  bool improve(FaceId f);
  bool insert_other_point(FaceId f, bool is_near);
  // True if f's circumcenter is near f, so that a point near the one is near the other.
  bool is_center_near(FaceId f) const;
  bool move(FaceId f) { return !met_frozen_ && accept(move_corner(r_, f)); }
  // Returns true if an operation was done. Then it queues the facets created, and marks them and
  // their neighbors as not done.
  bool accept(const std::optional<Refusal>& refusal);
  // Queues f if it violates a criterion, a side of it is off its curve, or `at_least` is over 1;
  // not if it is left.
  void enqueue(FaceId f, double at_least = 0);
  // True if f is left to blocks/seams.h: it touches a seam, which has all vertices of T, and will
  // be coarsened with it. Refined before, half of a block's insertions would be there, and go
  // again.
  bool is_left(FaceId f) const;
  // Returns why f must be refined; nullopt if it need not. `is_alone`: no other vertex is near it.
  std::optional<Reason> fault(FaceId f, bool is_alone = false) const;
  // Returns the violation that f was queued with, or measures it.
  double violation_of(FaceId f) const {
    const bool is_known = f < violation_.size() && violation_[f] >= 0;
    return is_known ? violation_[f] : r_.violation(mesh_.faces[f].v, r_.s.duals[f]);
  }
  // Returns the side of f that is too far from its boundary curve; 3: none.
  int side_off_curve(FaceId f) const;
  void flip_to_delaunay();
  bool insert_far_samples();
  void make_delaunay();
  // Marks vertices that may be within the gap of f. Returns true if there are any.
  bool crowds(FaceId f);
  // Moves facets apart (refine/separate.h).
  void keep_apart();
  void require_room() const;  // throws InputError at max_vertices
  bool is_live(FaceId f) const { return !is_dead(mesh_.faces[f]) && !r_.is_frozen(f); }

  Refinement& r_;
  const TriMesh& mesh_;
  std::span<const Vec3> samples_;
  std::vector<std::uint32_t>& far_;
  FacetQueue queue_;
  Steps steps_;
  // Per facet: no operation is tried until a facet near it changes.
  std::vector<std::uint8_t> is_done_;
  // Per facet: it came, or every operation was refused, since moves are allowed.
  std::vector<std::uint8_t> is_unsettled_;
  IdArray<VertexId, std::uint8_t> is_near_change_;  // an operation was done there
  IdArray<VertexId, std::uint8_t> is_crowded_;      // for separate()
  IdArray<FaceId, double> violation_;  // of facets that were queued; of others less than 0
  std::vector<FaceId> refused_;        // in this pass of refine_worst_first()
  std::vector<FaceId> changed_;        // to be tested for flips
  // Per facet: its edges are Delaunay, and neither it nor a neighbor has changed since.
  std::vector<std::uint8_t> has_delaunay_edges_;
  bool met_frozen_ = false;  // a frozen facet refused the last operation
};

std::vector<std::uint8_t> RefineGeom::run(std::vector<std::uint8_t> is_done, bool thins) {
  is_done_ = std::move(is_done);
  is_done_.resize(mesh_.faces.size(), 0);
  has_delaunay_edges_.resize(mesh_.faces.size(), 0);
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f]) changed_.push_back(f);
  }
  std::ranges::reverse(changed_);  // flip_to_delaunay() begins at the end
  flip_to_delaunay();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_live(f) && !is_done_[f]) enqueue(f);
  }
  refine_worst_first(Moves::no);
  if (thins) thin();
  while (insert_far_samples()) refine_worst_first(Moves::no);
  is_unsettled_.clear();
  refine_worst_first(Moves::yes);
  for (int n = 0; n < kDelaunayRounds; ++n) make_delaunay();
  keep_apart();
  return std::move(is_done_);
}

void RefineGeom::thin() {
  std::vector<VertexId> near;
  for (VertexId v = 0; v < std::min(is_near_change_.size(), r_.inserted); ++v) {
    if (is_near_change_[v] != 0) near.push_back(v);
  }
  for (Thinning thinning(r_, near); thinning.has_next();) accept(thinning.remove_next());
  flip_to_delaunay();
  refine_worst_first(Moves::no);
}

void RefineGeom::refine_worst_first(Moves moves) {
  for (bool any = true; any;) {
    any = false;
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      const auto reason = is_dead(mesh_.faces[f]) ? std::nullopt : fault(f);
      if (!reason) continue;  // removed, or good since an operation near it
      require_room();
      const Question question(r_, f, *reason);
      if (improve(f) || (moves == Moves::yes && move(f))) {
        any = true;
      } else {
        refused_.push_back(f);
        is_done_[f] = moves == Moves::yes && !met_frozen_;
        is_unsettled_.resize(mesh_.faces.size(), 0);
        is_unsettled_[f] = 1;
      }
      steps_.step(queue_.size());
    }
    // An edge between a new facet and an old one need not be Delaunay.
    flip_to_delaunay();
    // Refused facets are tried again; in the next pass their surroundings may have changed.
    for (const FaceId f : std::exchange(refused_, {})) {
      if (is_live(f) && !is_done_[f]) enqueue(f);
    }
  }
}

bool RefineGeom::improve(FaceId f) {
  met_frozen_ = false;
  const int side = side_off_curve(f);
  if (side == 3 && violation_of(f) <= 1 &&
      r_.shape(f).r <= kMinDelaunayRMins * r_.parameters.r_min) {
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
  const double longest = std::sqrt(length2(i));
  return (is_near && insert_foot(center, std::min(distance(center, p[0]), longest))) ||
         insert_foot(middle, 0.5 * longest);
}

bool RefineGeom::accept(const std::optional<Refusal>& refusal) {
  met_frozen_ |= refusal == Refusal::frozen;
  if (refusal) return false;
  is_done_.resize(mesh_.faces.size(), 0);
  has_delaunay_edges_.resize(mesh_.faces.size(), 0);
  is_unsettled_.resize(mesh_.faces.size(), 0);
  is_near_change_.resize(mesh_.points.size(), 0);
  for (const FaceId f : r_.created()) {
    for (const VertexId v : mesh_.faces[f].v) is_near_change_[v] = 1;
    enqueue(f);
    changed_.push_back(f);
    is_done_[f] = has_delaunay_edges_[f] = 0;
    is_unsettled_[f] = 1;
    for (const FaceId g : mesh_.faces[f].n) {
      if (g != kNoId) is_done_[g] = has_delaunay_edges_[g] = 0;
    }
  }
  return true;
}

bool RefineGeom::is_left(FaceId f) const {
  const BoundaryChain& chain = r_.s.chain;
  return r_.parameters.leaves_seams && std::ranges::any_of(mesh_.faces[f].v, [&](VertexId v) {
           return chain.is_boundary(v) && r_.curves.is_on_fixed(chain.place(v));
         });
}

void RefineGeom::enqueue(FaceId f, double at_least) {
  const Triangle& v = mesh_.faces[f].v;
  if (f >= violation_.size()) violation_.resize(mesh_.faces.size(), -1);
  violation_[f] = r_.violation(v, r_.s.duals[f]);
  const double asked = side_off_curve(f) < 3 ? kNotAsked : std::max(at_least, violation_[f]);
  queue_.set(f, asked > 1 && is_left(f) ? 0 : asked);
}

std::optional<Reason> RefineGeom::fault(FaceId f, bool is_alone) const {
  if (side_off_curve(f) < 3) return Reason::off_its_curve;
  if (violation_of(f) > 1) {
    return reason_of(worst_criterion(r_.shape(f), r_.parameters.refinement));
  }
  if (!r_.s.duals[f].on_surface) return Reason::no_surface_point;
  return is_alone || r_.is_delaunay(f) ? std::nullopt : std::optional(Reason::not_delaunay);
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
void RefineGeom::flip_to_delaunay() {
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    if (is_dead(mesh_.faces[f]) || has_delaunay_edges_[f]) continue;
    const Question question(r_, f, Reason::not_delaunay);
    bool is_delaunay = true;
    for (int i = 0; i < 3; ++i) {
      const FaceId g = mesh_.faces[f].n[i];
      // An edge is tested once, from the first of its facets.
      if (g == kNoId || has_delaunay_edges_[g] || is_edge_delaunay(r_, f, i)) continue;
      is_delaunay = false;
      if (accept(flip_if_not_delaunay(r_, f, i))) break;
    }
    has_delaunay_edges_[f] = is_delaunay;
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
    require_room();
    const Question question(r_, at.facet, Reason::far_point);
    any |= accept(insert_point(r_, Operation::far_point, at.facet, samples_[at.sample]));
  }
  return any;
}

void RefineGeom::make_delaunay() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (!is_live(f) || is_done_[f] || is_left(f)) continue;
    const bool is_alone = !crowds(f);
    if (fault(f, is_alone)) {
      enqueue(f, kLastInQueue);
    } else {
      is_done_[f] = 1;
    }
  }
  refine_worst_first(Moves::yes);
}

bool RefineGeom::crowds(FaceId f) {
  bool any = false;
  r_.for_each_vertex_near(f, [&](VertexId v) {
    is_crowded_.resize(mesh_.points.size(), 0);
    is_crowded_[v] = 1;
    any = true;
  });
  return any;
}

void RefineGeom::keep_apart() {
  is_unsettled_.resize(mesh_.faces.size(), 0);
  is_crowded_.resize(mesh_.points.size(), 0);
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (!is_live(f) || !is_unsettled_[f]) continue;
    crowds(f);
    for (const VertexId v : mesh_.faces[f].v) is_crowded_[v] = 1;
  }
  for (const FaceId f : separate(r_, is_crowded_)) {
    is_done_.resize(mesh_.faces.size(), 0);
    is_done_[f] = 1;
  }
}

void RefineGeom::require_room() const {
  const std::size_t most = r_.parameters.max_vertices;
  if (mesh_.points.size() < most) return;
  throw InputError("more than --max-vertices ", most, " vertices needed");
}

}  // namespace

std::vector<std::uint8_t> refine_part(SurfaceMesh& mesh, std::span<const Vec3> samples,
                                      const Given& given, RefineScope scope) {
  const StepTimer timer(given.report.seconds_refine);
  std::vector<std::uint32_t> far(samples.size());
  std::iota(far.begin(), far.end(), 0);
  Refinement refinement(mesh, given, scope.free_box);
  return RefineGeom(refinement, samples, far).run(std::move(scope.is_done), scope.thins);
}

void refine(SurfaceMesh& mesh, std::span<const Vec3> samples, const Given& given) {
  begin_stage(given.parameters.observer, "refine");
  RefineScope scope;
  scope.free_box = FreeBox::within(given.surface.volume());
  // Only a bound on the distance says which vertices a mesh needs.
  scope.thins = given.parameters.refinement.asks(Criterion::distance);
  refine_part(mesh, samples, given, std::move(scope));
  remove_dead(mesh);
}

}  // namespace deliso
