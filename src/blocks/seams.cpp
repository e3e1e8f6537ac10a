// SPDX-License-Identifier: MIT
#include "blocks/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/parallel.h"
#include "blocks/patch.h"
#include "coarsen/coarsen.h"
#include "refine/coverage.h"
#include "refine/refine.h"
#include "run/observer.h"

namespace deliso {
namespace {

// Half the thickness of the boxes of each round, in samples; at most this share of the side of a
// block between two planes.
constexpr std::array kHalfSamples{8.0, 12.0, 16.0};
constexpr std::array kMaxShares{0.25, 0.375, 0.5};
// Vertices or facets that one task looks at.
constexpr std::size_t kGrain = 1 << 14;

// The boxes of a round. The planes between blocks cut an axis into intervals: even ones lie between
// planes, odd ones around one. A box has a number of an interval for each axis.
class RoundBoxes {
 public:
  RoundBoxes(const BlockRun& run, std::size_t round) : grid_(run.grid), round_(round) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<int>& planes = grid_.planes[axis];
      std::vector<double>& ends = ends_[axis];
      ends.push_back(-FreeBox::kFar);
      for (std::size_t n = 1; n + 1 < planes.size(); ++n) {
        const double half =
            std::min(kHalfSamples[round], kMaxShares[round] * grid_.room_at(axis, n));
        ends.push_back(run.source.shape.at_samples(planes[n] - half, axis));
        ends.push_back(run.source.shape.at_samples(planes[n] + half, axis));
      }
      ends.push_back(FreeBox::kFar);
    }
  }

  std::size_t size() const { return count(0) * count(1) * count(2); }

  // Returns the number of the place that holds p: a box of this round, or what is between them.
  std::size_t at(const Vec3& p) const {
    return number(interval(0, p.x), interval(1, p.y), interval(2, p.z));
  }
  bool is_box(std::size_t number) const {
    const auto [i, j, k] = intervals(number);
    return is_box(i, j, k);
  }

  // Calls visit(number) for the boxes that meet the box.
  template <class Visit>
  void for_each(const Box3& box, Visit&& visit) const {
    std::array<std::size_t, 3> lo, hi;
    for (int a = 0; a < 3; ++a) {
      lo[a] = interval(a, box.lo[a]);
      hi[a] = interval(a, box.hi[a]);
    }
    for (std::size_t k = lo[2]; k <= hi[2]; ++k) {
      for (std::size_t j = lo[1]; j <= hi[1]; ++j) {
        for (std::size_t i = lo[0]; i <= hi[0]; ++i) {
          if (is_box(i, j, k)) visit(number(i, j, k));
        }
      }
    }
  }

  // Returns the cells that the box lies in, by their numbers in the grid.
  std::vector<std::size_t> cells(std::size_t number) const {
    const std::array<std::size_t, 3> at = intervals(number);
    std::vector<std::size_t> cells;
    for (int corner = 0; corner < 8; ++corner) {
      Index3 cell;
      bool is_new = true;
      for (int axis = 0; axis < 3; ++axis) {
        const auto interval = at[axis];
        const int beyond = corner >> axis & 1;
        is_new &= beyond == 0 || (interval & 1) != 0;
        cell[axis] = static_cast<int>(interval / 2) + beyond;
      }
      if (is_new) cells.push_back(grid_.number_of(cell));
    }
    return cells;
  }

  FreeBox free_box(std::size_t number) const {
    const auto [i, j, k] = intervals(number);
    const auto& [x, y, z] = ends_;
    return {0, {x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}};
  }

 private:
  std::size_t count(int axis) const { return ends_[axis].size() - 1; }
  std::size_t interval(int axis, double x) const {
    return std::ranges::upper_bound(ends_[axis], x) - ends_[axis].begin() - 1;
  }
  std::array<std::size_t, 3> intervals(std::size_t number) const {
    const std::size_t rest = number / count(0);
    return {number % count(0), rest % count(1), rest / count(1)};
  }
  bool is_box(std::size_t i, std::size_t j, std::size_t k) const {
    return (i & 1) + (j & 1) + (k & 1) == round_ + 1;
  }
  std::size_t number(std::size_t i, std::size_t j, std::size_t k) const {
    return i + count(0) * (j + count(1) * k);
  }

  const BlockGrid& grid_;
  std::size_t round_;
  std::array<std::vector<double>, 3> ends_;  // of the intervals
};

// Returns the samples in the free box and some around it.
SampleBox samples_around(const BlockRun& run, const FreeBox& free_box) {
  SampleBox box;
  const Index3 last = run.source.shape.voxels();
  for (int axis = 0; axis < 3; ++axis) {
    const auto clamped = [&](double at) {
      return static_cast<int>(std::clamp<double>(at, 0, last[axis]));
    };
    const double low = run.source.shape.in_all_samples(free_box.lo, axis),
                 high = run.source.shape.in_all_samples(free_box.hi, axis);
    box.begin[axis] = clamped(std::floor(low) - kSeamMarginSamples);
    box.end[axis] = clamped(std::ceil(high) + kSeamMarginSamples);
  }
  return box;
}

// What of the mesh is left to do at the seams.
class SeamWork {
 public:
  SeamWork(const BlockRun& run, Block& whole, const IsDue& is_due, Observer* observer)
      : run_(run),
        whole_(whole),
        is_due_(is_due),
        threads_(run.options.threads),
        observer_(observer),
        is_open_(whole.is_open),
        may_thin_(whole.may_thin),
        samples_(whole.samples_near_seams) {}

  void refine_round(std::size_t number) {
    const RoundBoxes boxes(run_, number);
    find_places(boxes);
    std::vector<MeshPatch> patches = patches_of(boxes);
    begin_stage(observer_, "seams");
    std::mutex mutex;
    std::size_t left = patches.size();
    for_each_task(threads_, patches.size(), [&](std::size_t n) {
      refine_patch(patches[n]);
      const std::lock_guard lock(mutex);
      ++boxes_done_;
      if (observer_) observer_->steps_done(boxes_done_, --left);
    });
    for (MeshPatch& patch : patches) take_back(std::exchange(patch, {}));
  }

 private:
  Box3 box_of_facet(FaceId f) const {
    const Triangle& v = whole_.mesh.mesh.faces[f].v;
    const std::vector<Vec3>& p = whole_.mesh.mesh.points;
    return box_of(p[v[0]], p[v[1]], p[v[2]]);
  }

  // Sets the places of all vertices and facets; dead ones are at place 0, which is no box.
  void find_places(const RoundBoxes& boxes) {
    const TriMesh& mesh = whole_.mesh.mesh;
    Places<VertexId>& vertices = places_.vertices;
    Places<FaceId>& facets = places_.facets;
    vertices.number.assign(mesh.points.size(), kNoId);
    facets.number.assign(mesh.faces.size(), kNoId);
    vertices.of.resize(mesh.points.size());
    facets.of.resize(mesh.faces.size());
    for_each_run(threads_, mesh.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (VertexId v(begin); v < end; ++v) {
        vertices.of[v] = static_cast<std::uint32_t>(boxes.at(mesh.points[v]));
      }
    });
    for_each_run(threads_, mesh.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (FaceId f(begin); f < end; ++f) {
        const Triangle& t = mesh.faces[f].v;
        const auto at = [&](int i) { return vertices.of[t[i]]; };
        facets.of[f] = is_dead(mesh.faces[f])             ? 0
                       : at(0) == at(1) && at(0) == at(2) ? at(0)
                                                          : std::uint32_t{kNoId};
      }
    });
  }

  // Returns the boxes with open facets, and what lies in them.
  std::vector<MeshPatch> patches_of(const RoundBoxes& boxes) {
    const auto for_each_place = [&](FaceId f, auto&& visit) {
      if (const std::uint32_t place = places_.facets.of[f]; place != kNoId) {
        visit(place);
      } else {
        boxes.for_each(box_of_facet(f), visit);
      }
    };
    const std::size_t facets = places_.facets.of.size();
    std::vector<std::uint32_t> number(boxes.size(), kNoId);
    for (FaceId f = 0; f < facets; ++f) {
      if (is_open_[f] != 0) for_each_place(f, [&](std::size_t place) { number[place] = 0; });
    }
    std::vector<MeshPatch> patches;
    for (std::uint32_t place = 0; place < number.size(); ++place) {
      if (number[place] == kNoId) continue;
      const bool is_due = boxes.is_box(place) && is_due_(boxes.cells(place));
      number[place] = is_due ? static_cast<std::uint32_t>(patches.size()) : std::uint32_t{kNoId};
      if (!is_due) continue;
      MeshPatch& patch = patches.emplace_back();
      patch.place = place;
      patch.free_box = boxes.free_box(place);
    }
    for (FaceId f = 0; f < facets; ++f) {
      for_each_place(f, [&](std::size_t place) {
        if (number[place] != kNoId) patches[number[place]].facets.push_back(f);
      });
    }
    // A sample goes to the box that holds all facets which may be near enough to it.
    const double margin = kCoverageDistances * run_.parameters.refinement[Criterion::distance];
    std::erase_if(samples_, [&](const Vec3& p) {
      const std::size_t box = boxes.at(p);
      if (number[box] == kNoId) return false;
      MeshPatch& patch = patches[number[box]];
      if (!patch.free_box.holds(p, margin)) return false;
      patch.samples.push_back(p);
      return true;
    });
    return patches;
  }

  void refine_patch(MeshPatch& patch) {
    extract(whole_.mesh, patch, places_);
    for (const FaceId f : patch.facets) patch.is_done.push_back(is_open_[f] == 0);
    for (VertexId v = patch.first_held; v < patch.vertices.size(); ++v) {
      if (may_thin_[patch.vertices[v]] != 0) patch.first.push_back(v);
    }
    const BoxSurface at(run_.source.read(samples_around(run_, patch.free_box)), run_.kappa);
    const BoundaryCurves curves(at.surface, whole_.loops);
    const Given given{at.surface, curves, run_.parameters, patch.report};
    const std::vector<std::uint8_t> changed = coarsen(
        patch.mesh, given, coarsening_bound(run_.parameters), {patch.free_box, patch.first});
    for (std::size_t f = 0; f < changed.size(); ++f) patch.is_done[f] &= changed[f] == 0;
    patch.is_done = refine_part(patch.mesh, patch.samples, given,
                                {patch.free_box, std::move(patch.is_done), true});
    patch.samples = {};  // patches wait for each other
    patch.mesh.shrink_to_fit();
  }

  // Puts what was refined back into the whole, and marks what is left to do there.
  void take_back(MeshPatch patch) {
    const std::size_t old = patch.facets.size();
    for (VertexId v = patch.first_held; v < patch.vertices.size(); ++v) {
      may_thin_[patch.vertices[v]] = 0;
    }
    const std::vector<FaceId> facets = put_back(whole_.mesh, patch);
    is_open_.resize(whole_.mesh.mesh.faces.size(), 0);
    may_thin_.resize(whole_.mesh.mesh.points.size(), 0);
    for (FaceId f = patch.free_box.first_free; f < facets.size(); ++f) {
      if (is_dead(patch.mesh.mesh.faces[f])) continue;
      // A facet whose surface ball leaves the box may not be Delaunay: it is asked again.
      const Dual& dual = patch.mesh.duals[f];
      const bool was_open = f >= old || is_open_[facets[f]] != 0;
      is_open_[facets[f]] =
          !patch.is_done[f] ||
          (was_open && !patch.free_box.holds(dual.center, std::sqrt(dual.radius2)));
    }
    whole_.report.add(patch.report);
  }

  const BlockRun& run_;
  Block& whole_;
  const IsDue& is_due_;
  const int threads_;
  Observer* const observer_;
  IdArray<FaceId, std::uint8_t>& is_open_;
  IdArray<VertexId, std::uint8_t>& may_thin_;
  PlacesInPatches places_;
  std::size_t boxes_done_ = 0;
  std::vector<Vec3>& samples_;  // not yet held against the mesh
};

}  // namespace

void refine_seams(const BlockRun& run, Block& whole, const IsDue& is_due, Observer* observer) {
  SeamWork work(run, whole, is_due, observer);
  for (std::size_t round = 0; round < kHalfSamples.size(); ++round) work.refine_round(round);
}

}  // namespace deliso
