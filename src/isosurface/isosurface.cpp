// SPDX-License-Identifier: MIT
#include "isosurface/isosurface.h"

#include <cmath>
#include <limits>

#include "isosurface/voxel_ray.h"

namespace deliso {
namespace {

// Number of voxels that a search walks without the kd-tree. The tree skips empty space, but a
// search in it descends from the root first.
constexpr int kWalkedVoxels = 12;

// The volume as the inner loops see it, in its own sample type.
template <class T>
struct Field {
  const Volume& volume;
  const T* samples;
  std::size_t dy, dz;
  T threshold;
  double kappa;
  CubicMethod method;

  Field(const Volume& v, const T* s, double isovalue, double first_inside, CubicMethod m)
      : volume(v),
        samples(s),
        dy(v.dims().i),
        dz(dy * v.dims().j),
        threshold(static_cast<T>(first_inside)),
        kappa(isovalue),
        method(m) {}

  const T* at(Index3 v) const { return samples + volume.index(v.i, v.j, v.k); }
  bool active(Index3 v) const { return is_active_voxel(at(v), dy, dz, threshold); }
  Roots roots(const VoxelSpan& span) const {
    return find_intersections(corners_from(at(span.voxel), dy, dz, kappa), span, method);
  }
};

// The hit nearest to t = 0 among those offered; at equal distance the one with positive t.
struct Nearest {
  Hit hit{};
  double distance = std::numeric_limits<double>::infinity();

  // Offers root n of the span.
  void offer(const VoxelSpan& span, const Roots& roots, int n, const Volume& volume) {
    const double s = roots.t[n], t = parameter_at(span, s);
    if (!(std::abs(t) < distance || (std::abs(t) == distance && t > hit.t))) return;
    hit = {t, point_at(span, s, volume), roots.leaves(n)};
    distance = std::abs(t);
  }
};

// One of the two directions from the center. Walks on the line or on the reversed line, so t grows.
template <class T>
class Side {
 public:
  // Starts in the voxel after `first`, which is the first one of the line given.
  Side(const Field<T>& field, const LatticeLine& line, const VoxelSpan& first, double end,
       bool backward)
      : field_(field), walk_(line, first.voxel, {first.t0, end}), line_(line), backward_(backward) {
    walk_.step();
  }

  bool done(const Nearest& best) const { return walk_.done() || walk_.t() > best.distance; }
  double t() const { return walk_.t(); }

  void step(Nearest& best, std::uint64_t& computations) {
    if (field_.active(walk_.voxel())) solve(walk_.span(), best, computations);
    walk_.step();
  }

  // Searches the rest with the tree. The first voxel with a hit has the nearest one.
  void finish(const VoxelTree& tree, Nearest& best, std::uint64_t& computations) const {
    tree.find_along(line_, {walk_.t(), walk_.end()}, field_.samples, field_.threshold,
                    [&](const VoxelSpan& span) {
                      return span.t0 > best.distance || solve(span, best, computations);
                    });
  }

 private:
  // Solves along the line itself, so that both directions round to the same hits.
  bool solve(const VoxelSpan& ahead, Nearest& best, std::uint64_t& computations) const {
    const VoxelSpan span = backward_ ? reversed(ahead) : ahead;
    const Roots roots = field_.roots(span);
    ++computations;
    if (roots.count == 0) return false;
    best.offer(span, roots, backward_ ? roots.count - 1 : 0, field_.volume);
    return true;
  }

  const Field<T>& field_;
  VoxelWalk walk_;
  const LatticeLine& line_;
  bool backward_;
};

template <class T>
Nearest find_nearest(const Field<T>& field, const VoxelTree& tree, const LatticeLine& line,
                     double limit, std::uint64_t& computations) {
  Nearest best;
  // The voxel that holds the center, or the nearest one on the line, is solved once for both
  // directions.
  Range range{-limit, limit};
  const bool inside = line.starts_inside();
  if (!inside) range = line.clip(range);
  if (!(range.lo < range.hi)) return best;
  const Index3 voxel = inside ? line.voxel_after_origin()
                              : line.voxel_after(std::clamp(0.0, range.lo, range.hi), tree.box());
  const VoxelSpan first = line.span(voxel, range);
  if (field.active(voxel) && !first.empty()) {
    ++computations;
    const Roots roots = field.roots(first);
    for (int n = 0; n < roots.count; ++n) best.offer(first, roots, n, field.volume);
  }
  if (best.distance < -first.t0 && best.distance < first.t1) return best;

  if (inside) range = line.clip(range);
  const LatticeLine reverse = line.reversed();
  Side<T> ahead(field, line, first, range.hi, false);
  Side<T> behind(field, reverse, reversed(first), -range.lo, true);
  for (int n = 0; n < kWalkedVoxels; ++n) {
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
    : volume_(volume), tree_(tree), kappa_(kappa), method_(method), empty_(!tree.active(kappa)) {
  if (empty_) return;
  threshold_ = volume.visit([&](const auto* samples) {
    return static_cast<double>(*inside_threshold<std::remove_cvref_t<decltype(*samples)>>(kappa));
  });
}

void Isosurface::intersect(const Segment& r, std::vector<Hit>& hits,
                           SearchCounters& counters) const {
  hits.clear();
  std::uint64_t computations = 0;
  const LatticeLine line = tree_.lattice_line(r.a, r.direction());
  const Range range = line.clip({0, 1});
  if (!empty_ && range.lo < range.hi) {
    volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, threshold_, method_);
      const auto solve = [&](const VoxelSpan& span) {
        ++computations;
        const Roots roots = field.roots(span);
        for (int n = 0; n < roots.count; ++n) {
          const double s = roots.t[n];
          hits.push_back({parameter_at(span, s), point_at(span, s, volume_), roots.leaves(n)});
        }
        return false;
      };
      if (!line.is_shorter(range, kWalkedVoxels)) {
        tree_.find_along(line, range, samples, field.threshold, solve);
        return;
      }
      const Index3 first = line.voxel_after(range.lo, tree_.box());
      for (VoxelWalk walk(line, first, range); !walk.done(); walk.step())
        if (field.active(walk.voxel())) solve(walk.span());
    });
  }
  count_search(counters, computations, !hits.empty());
}

std::optional<Hit> Isosurface::nearest(const Vec3& center, const Vec3& direction, double limit,
                                       SearchCounters& counters) const {
  std::uint64_t computations = 0;
  Nearest best;
  const LatticeLine line = tree_.lattice_line(center, direction);
  if (!empty_ && line.valid()) {
    best = volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, threshold_, method_);
      return find_nearest(field, tree_, line, limit, computations);
    });
  }
  const bool hit = best.distance <= limit && std::isfinite(best.distance);
  count_search(counters, computations, hit);
  if (!hit) return std::nullopt;
  return best.hit;
}

}  // namespace deliso
