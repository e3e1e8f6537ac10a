// SPDX-License-Identifier: MIT
#include "isosurface/boundary_midpoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace deliso {
namespace {

// A share of the chord. Roots this far outside their pixel count, so that rounding loses none
// between two pixels.
constexpr double kRootTolerance = 1e-12;

// Sigma along a line in a box face, pixel by pixel: in each pixel the value is a quadratic.
class FaceLine {
 public:
  FaceLine(const Volume& volume, double kappa, BoxFace face, const Vec3& from,
           const Vec3& direction)
      : volume_(volume),
        kappa_(kappa),
        across_(axis_of(face)),
        layer_((face & 1) != 0 ? volume.dims()[across_] - 1 : 0),
        from_(from),
        direction_(direction) {}

  // Returns the smallest t in [0, limit] with a root at from + t * direction.
  std::optional<double> first_root(double limit) const {
    double t = 0;
    while (t < limit) {
      const double next = std::min(limit, next_grid_line(t));
      if (const auto root = root_between(t, next)) return root;
      t = next;
    }
    return std::nullopt;
  }

 private:
  int axis_u() const { return (across_ + 1) % 3; }
  int axis_v() const { return (across_ + 2) % 3; }
  double grid(int axis, double t) const { return volume_.in_samples(from_ + t * direction_, axis); }

  double next_grid_line(double t) const {
    double next = std::numeric_limits<double>::infinity();
    for (const int axis : {axis_u(), axis_v()}) {
      if (const double* places = volume_.places(axis)) {
        next = std::min(next, next_place(places, axis, t));
        continue;
      }
      const double d = direction_[axis] / volume_.spacing()[axis];
      if (d == 0) continue;
      const double at = grid(axis, 0);
      double line = d > 0 ? std::floor(grid(axis, t)) + 1 : std::ceil(grid(axis, t)) - 1;
      double candidate = (line - at) / d;
      while (candidate <= t) {
        line += d > 0 ? 1 : -1;
        candidate = (line - at) / d;
      }
      next = std::min(next, candidate);
    }
    return next;
  }

  // The same along an axis of uneven steps.
  double next_place(const double* places, int axis, double t) const {
    const double d = direction_[axis];
    const int count = volume_.dims()[axis], step = d > 0 ? 1 : -1;
    int n = gap_at(places, count, from_[axis] + t * d) + (d > 0 ? 1 : 0);
    while (d != 0 && 0 <= n && n < count) {
      const double candidate = (places[n] - from_[axis]) / d;
      if (candidate > t) return candidate;
      n += step;
    }
    return std::numeric_limits<double>::infinity();
  }

  // Returns the first root in [low, high], which lies in one pixel.
  std::optional<double> root_between(double low, double high) const {
    const double middle = 0.5 * (low + high);
    Index3 corner;
    corner[across_] = layer_;
    std::array<double, 2> start, slope;
    int n = 0;
    for (const int axis : {axis_u(), axis_v()}) {
      const int last = volume_.dims()[axis] - 2;
      corner[axis] = std::clamp(static_cast<int>(std::floor(grid(axis, middle))), 0, last);
      start[n] = grid(axis, low) - corner[axis];
      slope[n] = direction_[axis] / volume_.sides(corner)[axis];
      ++n;
    }
    const auto value = [&](int du, int dv) {
      Index3 s = corner;
      s[axis_u()] += du;
      s[axis_v()] += dv;
      return volume_.sample(s.i, s.j, s.k) - kappa_;
    };
    const double v00 = value(0, 0), v10 = value(1, 0), v01 = value(0, 1), v11 = value(1, 1);
    const double ku = v10 - v00, kv = v01 - v00, kuv = (v11 - v01) - ku;
    // a s^2 + b s + c with s = t - low.
    const double a = kuv * slope[0] * slope[1];
    const double b = (ku + kuv * start[1]) * slope[0] + (kv + kuv * start[0]) * slope[1];
    const double c = v00 + ku * start[0] + kv * start[1] + kuv * start[0] * start[1];
    const double length = high - low;
    double best = std::numeric_limits<double>::infinity();
    const double discriminant = b * b - 4 * a * c;
    if (c == 0) return low;
    if (discriminant < 0) return std::nullopt;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double s : {q / a, c / q}) {
      if (s >= -kRootTolerance && s <= length + kRootTolerance)
        best = std::min(best, std::clamp(s, 0.0, length));
    }
    if (best > length) return std::nullopt;
    return low + best;
  }

  const Volume& volume_;
  double kappa_;
  int across_, layer_;
  Vec3 from_, direction_;
};

}  // namespace

std::optional<Vec3> boundary_midpoint(const Volume& volume, double kappa, BoxFace face,
                                      const Vec3& a, const Vec3& b) {
  const int across = axis_of(face), u = (across + 1) % 3, v = (across + 2) % 3;
  const double du = b[u] - a[u], dv = b[v] - a[v];
  if (du == 0 && dv == 0) return std::nullopt;
  const Box3 box = volume.box();
  Vec3 middle, normal;
  middle[across] = (face & 1) != 0 ? box.hi[across] : box.lo[across];
  middle[u] = 0.5 * (a[u] + b[u]);
  middle[v] = 0.5 * (a[v] + b[v]);
  normal[u] = -dv;
  normal[v] = du;
  const auto clamped = [&](Vec3 p) {
    p[across] = middle[across];
    for (const int axis : {u, v}) p[axis] = std::clamp(p[axis], box.lo[axis], box.hi[axis]);
    return p;
  };
  // Meshes from files may have edges far off the box: the line is searched within the box alone.
  const auto search = [&](const Vec3& direction) -> std::optional<double> {
    const Range inside = clip(middle, direction, {0, 0.5}, box);
    if (inside.empty()) return std::nullopt;
    const Vec3 from = clamped(middle + inside.lo * direction);
    const FaceLine line(volume, kappa, face, from, direction);
    const std::optional<double> root = line.first_root(inside.hi - inside.lo);
    if (!root) return std::nullopt;
    return inside.lo + *root;
  };
  const std::optional<double> ahead = search(normal), behind = search(-normal);
  if (!ahead && !behind) return std::nullopt;
  return clamped(middle +
                 (!behind || (ahead && *ahead <= *behind) ? *ahead * normal : -*behind * normal));
}

}  // namespace deliso
