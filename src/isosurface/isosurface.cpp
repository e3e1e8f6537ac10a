// SPDX-License-Identifier: MIT
#include "isosurface/isosurface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "isosurface/voxel_ray.h"

namespace deliso {
namespace {

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

 private:
  // Solves along the line itself, so that both directions round to the same hits.
  void solve(const VoxelSpan& ahead, Nearest& best, std::uint64_t& computations) const {
    const VoxelSpan span = backward_ ? reversed(ahead) : ahead;
    const Roots roots = field_.roots(span);
    ++computations;
    if (roots.count > 0) best.offer(span, roots, backward_ ? roots.count - 1 : 0, field_.volume);
  }

  const Field<T>& field_;
  VoxelWalk walk_;
  const LatticeLine& line_;
  bool backward_;
};

template <class T>
Nearest find_nearest(const Field<T>& field, const VoxelBox& box, const LatticeLine& line,
                     double limit, std::uint64_t& computations) {
  Nearest best;
  // The voxel that holds the center, or the nearest one on the line, is solved once for both
  // directions.
  Range range{-limit, limit};
  const bool inside = line.starts_inside();
  if (!inside) range = line.clip(range);
  if (!(range.lo < range.hi)) return best;
  const Index3 voxel = inside ? line.voxel_after_origin()
                              : line.voxel_after(std::clamp(0.0, range.lo, range.hi), box);
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
  while (true) {
    const bool ahead_done = ahead.done(best), behind_done = behind.done(best);
    if (ahead_done && behind_done) return best;
    const bool forward = behind_done || (!ahead_done && ahead.t() <= behind.t());
    (forward ? ahead : behind).step(best, computations);
  }
}

}  // namespace

Isosurface::Isosurface(const Volume& volume, double kappa, CubicMethod method)
    : volume_(volume), units_(volume), kappa_(kappa), method_(method) {
  const Index3 n = volume.voxels();
  if (std::min({n.i, n.j, n.k}) == 0) return;
  volume.visit([&](const auto* samples) {
    const auto first = inside_threshold<std::remove_cvref_t<decltype(*samples)>>(kappa);
    empty_ = !first;
    if (first) threshold_ = static_cast<double>(*first);
  });
}

void Isosurface::intersect(const Segment& r, std::vector<Hit>& hits,
                           SearchCounters& counters) const {
  hits.clear();
  std::uint64_t computations = 0;
  const LatticeLine line = units_.line(r.a, r.direction());
  const Range range = line.clip({0, 1});
  if (!empty_ && range.lo < range.hi) {
    volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, threshold_, method_);
      const Index3 first = line.voxel_after(range.lo, units_.box());
      for (VoxelWalk walk(line, first, range); !walk.done(); walk.step()) {
        if (!field.active(walk.voxel())) continue;
        const VoxelSpan span = walk.span();
        const Roots roots = field.roots(span);
        ++computations;
        for (int n = 0; n < roots.count; ++n) {
          const double s = roots.t[n];
          hits.push_back({parameter_at(span, s), point_at(span, s, volume_), roots.leaves(n)});
        }
      }
    });
  }
  counters.count_search(computations, !hits.empty());
}

std::optional<Hit> Isosurface::nearest(const Vec3& center, const Vec3& direction, double limit,
                                       SearchCounters& counters) const {
  std::uint64_t computations = 0;
  Nearest best;
  const LatticeLine line = units_.line(center, direction);
  if (!empty_ && line.valid()) {
    best = volume_.visit([&](const auto* samples) {
      const Field field(volume_, samples, kappa_, threshold_, method_);
      return find_nearest(field, units_.box(), line, limit, computations);
    });
  }
  const bool hit = best.distance <= limit && std::isfinite(best.distance);
  counters.count_search(computations, hit);
  if (!hit) return std::nullopt;
  return best.hit;
}

}  // namespace deliso
