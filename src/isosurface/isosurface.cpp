// SPDX-License-Identifier: MIT
#include "isosurface/isosurface.h"

#include <cmath>
#include <limits>

#include "isosurface/voxel_ray.h"

namespace deliso {
namespace {

// Voxels that nearest() walks on each side before it turns to the kd-tree, which skips empty space.
constexpr int kWalkedVoxels = 6;

// The volume as the inner loops see it: in its own sample type.
template <class T>
struct Field {
  const Volume& volume;
  const T* samples;
  std::size_t dy, dz;
  T threshold;
  double kappa;
  CubicMethod method;

  Field(const Volume& v, const T* s, double isovalue, CubicMethod m)
      : volume(v),
        samples(s),
        dy(static_cast<std::size_t>(v.dims().i)),
        dz(dy * static_cast<std::size_t>(v.dims().j)),
        threshold(inside_threshold<T>(isovalue)),
        kappa(isovalue),
        method(m) {}

  const T* at(Index3 v) const { return samples + volume.index(v.i, v.j, v.k); }
  bool active(Index3 v) const { return is_active_voxel(at(v), dy, dz, threshold); }
  Roots roots(const VoxelSpan& span) const {
    return find_intersections(corners_from(at(span.voxel), dy, dz, kappa), span, method);
  }
};

// The hit nearest to t = 0 so far; at equal distance the one with positive t.
struct Nearest {
  VoxelSpan span{};
  double s = 0, t = 0;
  double distance = std::numeric_limits<double>::infinity();

  void offer(const VoxelSpan& where, double fraction) {
    const double at = parameter_at(where, fraction);
    if (!(std::abs(at) < distance || (std::abs(at) == distance && at > t))) return;
    *this = {where, fraction, at, std::abs(at)};
  }
};

// One of the two ways from the center. Walks on the line or the reversed line, so that t grows.
template <class T>
class Side {
 public:
  Side(const Field<T>& field, const LatticeLine& line, Range range, const VoxelBox& box,
       bool backward)
      : field_(field), line_(line), walk_(line_, range, box), end_(range.hi), backward_(backward) {}

  Side(const Side&) = delete;  // the walk refers to line_
  Side& operator=(const Side&) = delete;

  bool done(const Nearest& best) const { return walk_.done() || walk_.t() > best.distance; }
  double t() const { return walk_.t(); }

  void step(Nearest& best, std::uint64_t& computations) {
    if (field_.active(walk_.voxel())) solve(walk_.span(), best, computations);
    walk_.step();
  }

  // All the rest, by the tree. The first voxel with a hit has the nearest.
  void finish(const VoxelTree& tree, Nearest& best, std::uint64_t& computations) const {
    tree.find_along(line_, {walk_.t(), end_}, field_.threshold, [&](const VoxelSpan& span) {
      return span.t0 > best.distance || solve(span, best, computations);
    });
  }

 private:
  // Solves in the direction of the line itself, so that both ways round to the same hits.
  bool solve(const VoxelSpan& ahead, Nearest& best, std::uint64_t& computations) const {
    const VoxelSpan span = backward_ ? reversed(ahead) : ahead;
    const Roots roots = field_.roots(span);
    ++computations;
    if (roots.count == 0) return false;
    best.offer(span, backward_ ? roots.back() : roots.front());
    return true;
  }

  const Field<T>& field_;
  LatticeLine line_;
  VoxelWalk walk_;
  double end_;
  bool backward_;
};

template <class T>
Nearest find_nearest(const Field<T>& field, const VoxelTree& tree, const LatticeLine& line,
                     Range range, std::uint64_t& computations) {
  Nearest best;
  // The voxel that holds the center, or the first on the way to it, is solved once for both ways.
  const double start = std::clamp(0.0, range.lo, range.hi);
  const VoxelBox box = tree.box();
  const auto index = [&](std::size_t axis) {
    return line.index_after(axis, start, 0, box.hi[static_cast<int>(axis)]);
  };
  const Index3 voxel{index(0), index(1), index(2)};
  Range here = range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int n = voxel[static_cast<int>(axis)];
    here.lo = std::max(here.lo, line.enter(axis, n, n + 1));
    here.hi = std::min(here.hi, line.leave(axis, n, n + 1));
  }
  if (field.active(voxel) && here.lo < here.hi) {
    const VoxelSpan span = line.span(voxel, here.lo, here.hi);
    ++computations;
    for (const double s : field.roots(span)) best.offer(span, s);
  }
  if (best.distance < std::min(std::abs(here.lo), std::abs(here.hi))) return best;

  Side<T> ahead(field, line, {here.hi, range.hi}, box, false);
  Side<T> behind(field, line.reversed(), {-here.lo, -range.lo}, box, true);
  for (int n = 0; n < 2 * kWalkedVoxels; ++n) {
    const bool ahead_done = ahead.done(best), behind_done = behind.done(best);
    if (ahead_done && behind_done) return best;
    const bool forward = behind_done || (!ahead_done && ahead.t() <= behind.t());
    (forward ? ahead : behind).step(best, computations);
  }
  if (!ahead.done(best)) ahead.finish(tree, best, computations);
  if (!behind.done(best)) behind.finish(tree, best, computations);
  return best;
}

void count_search(SearchCounters& counters, std::uint64_t computations, bool hit) {
  ++counters.searches;
  counters.computations += computations;
  if (!hit) return;
  ++counters.searches_with_hit;
  counters.computations_with_hit += computations;
}

}  // namespace

Isosurface::Isosurface(const Volume& volume, const VoxelTree& tree, double kappa,
                       CubicMethod method)
    : volume_(volume), tree_(tree), kappa_(kappa), method_(method), empty_(!tree.active(kappa)) {}

void Isosurface::intersect(const Segment& r, std::vector<Hit>& hits,
                           SearchCounters& counters) const {
  hits.clear();
  std::uint64_t computations = 0;
  const LatticeLine line = tree_.lattice_line(r.a, r.direction());
  const Range range = line.clip({0, 1}, tree_.box());
  if (!empty_ && range.lo < range.hi) {
    volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, method_);
      tree_.find_along(line, range, field.threshold, [&](const VoxelSpan& span) {
        ++computations;
        for (const double s : field.roots(span))
          hits.push_back({parameter_at(span, s), point_at(span, s, volume_.spacing())});
        return false;
      });
    });
  }
  count_search(counters, computations, !hits.empty());
}

std::optional<Hit> Isosurface::nearest(const Vec3& center, const Vec3& direction, double limit,
                                       SearchCounters& counters) const {
  std::uint64_t computations = 0;
  Nearest best;
  const LatticeLine line = tree_.lattice_line(center, direction);
  const Range range = line.clip({-limit, limit}, tree_.box());
  if (!empty_ && range.lo < range.hi) {
    best = volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, method_);
      return find_nearest(field, tree_, line, range, computations);
    });
  }
  const bool hit = best.distance <= limit && std::isfinite(best.distance);
  count_search(counters, computations, hit);
  if (!hit) return std::nullopt;
  return Hit{best.t, point_at(best.span, best.s, volume_.spacing())};
}

}  // namespace deliso
