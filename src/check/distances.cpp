// SPDX-License-Identifier: MIT
#include "check/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/triangle.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Distances as they are measured, and where the largest is.
class Measured {
 public:
  explicit Measured(double bound) : bound_(bound) {}
  void reserve(std::size_t count) { values_.reserve(count); }
  void add(double d, const Vec3& p) {
    values_.push_back(d);
    beyond_ += d > bound_;
    if (d <= max_) return;
    max_ = d;
    furthest_ = p;
  }
  Distances summary();

 private:
  double bound_;
  std::vector<double> values_;
  std::size_t beyond_ = 0;
  double max_ = -1;
  Vec3 furthest_;
};

Distances Measured::summary() {
  Distances d;
  d.points = values_.size();
  if (values_.empty()) return d;
  double sum = 0, squares = 0;
  for (const double value : values_) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(values_.size());
  d.mean = sum / n;
  d.rms = std::sqrt(squares / n);
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.999 * n)) - 1;
  std::nth_element(values_.begin(), values_.begin() + rank, values_.end());
  d.quantile_999 = values_[static_cast<std::size_t>(rank)];
  d.max = max_;
  d.beyond = beyond_;
  d.furthest = furthest_;
  return d;
}

double along(const Isosurface& surface, const Vec3& p, const Vec3& direction, double limit,
             SearchCounters& counters) {
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return kInfinity;
  const auto hit = surface.nearest(p, direction / size, limit, counters);
  return hit ? std::fabs(hit->t) : kInfinity;
}

}  // namespace

std::array<Measure, 4> measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c,
                                        const Isosurface& surface, double limit, double bound,
                                        SearchCounters& counters) {
  const Vec3 normal = area_normal(a, b, c);
  std::array<Measure, 4> measures{
      {{(a + b + c) / 3}, {0.5 * (a + b)}, {0.5 * (b + c)}, {0.5 * (c + a)}}};
  for (auto& [p, d] : measures) {
    const double steep = along(surface, p, surface.gradient(p), limit, counters);
    // The second search need not go further than the first found something.
    const double straight = along(surface, p, normal, std::min(limit, steep), counters);
    d = std::min(steep, straight);
    if (d > std::min(bound, limit / 8)) {  // both may run past a thin part of Sigma, or a small one
      for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, a - p, b - p, c - p}) {
        d = std::min(d, along(surface, p, axis, std::min(limit, d), counters));
      }
    }
  }
  return measures;
}

Distances distances_to_surface(const CleanMesh& mesh, const Isosurface& surface, double limit,
                               double bound) {
  Measured measured(bound);
  measured.reserve(4 * mesh.triangles.size());
  SearchCounters counters;
  std::size_t not_found = 0;
  Vec3 first_not_found;
  for (const Triangle& t : mesh.triangles) {
    for (const Measure& m : measure_triangle(mesh.points[t[0]], mesh.points[t[1]],
                                             mesh.points[t[2]], surface, limit, bound, counters)) {
      if (m.distance < kInfinity) {
        measured.add(m.distance, m.at);
      } else if (not_found++ == 0) {
        first_not_found = m.at;
      }
    }
  }
  Distances result = measured.summary();
  result.not_found = not_found;
  result.first_not_found = first_not_found;
  return result;
}

Distances distances_from_surface(const ContourMesh& contour, const TriangleTree& mesh_tree,
                                 double bound) {
  Measured measured(bound);
  measured.reserve(contour.points.size());
  for (const Vec3& p : contour.points) {
    const NearestTriangle nearest = mesh_tree.nearest(p);
    if (nearest.triangle == kNoId) break;
    measured.add(std::sqrt(nearest.distance2), p);
  }
  return measured.summary();
}

double off_surface(const Vec3& p, const Isosurface& surface, double tolerance, double limit) {
  const Volume& volume = surface.volume();
  const Corners corners = volume.corners(volume.voxel_at(p));
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  const double difference = std::fabs(volume.value(p) - surface.kappa());
  const Vec3 gradient = surface.gradient(p);
  const Box3 box = volume.box();
  bool near_box = true;
  for (int axis = 0; axis < 3; ++axis) {
    near_box &= p[axis] >= box.lo[axis] - tolerance && p[axis] <= box.hi[axis] + tolerance;
  }
  if (near_box &&
      (difference <= 1e-9 * (*most - *least) || difference <= tolerance * length(gradient))) {
    return 0;
  }
  SearchCounters counters;
  double d = limit;
  for (const Vec3& direction : {gradient, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    d = std::min(d, along(surface, p, direction, d, counters));
  }
  return d <= tolerance ? 0 : d;
}

}  // namespace deliso
