// SPDX-License-Identifier: MIT
#include "check/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/triangle.h"
#include "check/patch_at.h"
#include "isosurface/boundary_midpoint.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::size_t kTrianglesAtOnce = 1u << 10;

// Summarizes distances in their order. Infinite ones belong to points without Sigma, negative ones
// to points given up. `at` returns where number n was measured, `triangle_of` on which triangle.
template <class At, class TriangleOf>
Distances summarize(std::vector<double> values, const CleanMesh& mesh, const DistanceBound& bound,
                    const At& at, const TriangleOf& triangle_of) {
  const auto r_min_allows = [&](std::size_t n) {
    const Triangle& t = mesh.triangles[triangle_of(n)];
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    return values[n] <= bound.r_min && distance(circumcenter(a, b, c), a) <= bound.r_min;
  };

  Distances d;
  double sum = 0, squares = 0;
  std::size_t furthest = 0;
  d.max = -1;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double value = values[n];
    if (value == kInfinity) {
      if (d.not_found++ == 0) d.first_not_found = at(n);
      continue;
    }
    if (value < 0) {
      ++d.given_up;
      continue;
    }
    sum += value;
    squares += value * value;
    if (value > bound.distance) {
      ++d.beyond;
      if (!r_min_allows(n)) {
        ++d.too_far;
        if (value > d.max_too_far) {
          d.max_too_far = value;
          d.furthest_too_far = at(n);
        }
      }
    }
    if (value > d.max) {
      d.max = value;
      furthest = n;
    }
  }
  d.points = values.size() - d.not_found - d.given_up;
  if (d.points == 0) {
    d.max = 0;
    return d;
  }
  d.furthest = at(furthest);
  std::erase_if(values, [](double value) { return value < 0; });
  const auto n = static_cast<double>(d.points);
  d.mean = sum / n;
  d.rms = std::sqrt(squares / n);
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.999 * n)) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  d.quantile_999 = values[rank];
  return d;
}

// Returns the distance from the middle of a boundary edge to the curve on its face of the box; on
// an edge of the box, to the nearer of two curves. Infinite if the edge's ball does not meet it.
double distance_to_curve(const Vec3& a, const Vec3& b, const Isosurface& surface) {
  const Box3 box = surface.volume().box();
  double nearest = kInfinity;
  // Meshes from files may be off the planes by rounding.
  const double slack = 1e-6 * box.smallest_side();
  const unsigned faces = box_faces_at(a, box, slack) & box_faces_at(b, box, slack);
  for (int face = 0; face < 6; ++face) {
    if ((faces >> face & 1) == 0) continue;
    const auto x =
        boundary_midpoint(surface.volume(), surface.kappa(), static_cast<BoxFace>(face), a, b);
    if (x) nearest = std::min(nearest, distance(*x, 0.5 * (a + b)));
  }
  return nearest;
}

}  // namespace

std::array<Measure, 4> measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c,
                                        const Isosurface& surface, double limit, double bound,
                                        SearchCounters& counters) {
  const Vec3 normal = area_normal(a, b, c);
  std::array<Measure, 4> measures{
      {{(a + b + c) / 3}, {0.5 * (a + b)}, {0.5 * (b + c)}, {0.5 * (c + a)}}};
  for (auto& [p, d] : measures) {
    const PatchAt patch(surface, p);
    const double steep = patch.distance_along(patch.gradient(), limit, counters);
    // The second search is limited by the hit of the first.
    const double straight = patch.distance_along(normal, std::min(limit, steep), counters);
    d = std::min(steep, straight);
    if (d > std::min(bound, limit / 8)) {  // both may miss a thin or small piece of Sigma
      for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, a - p, b - p, c - p}) {
        d = std::min(d, patch.distance_along(axis, std::min(limit, d), counters));
      }
    }
  }
  return measures;
}

Distances distances_to_surface(const CleanMesh& mesh, const Isosurface& surface, double limit,
                               const DistanceBound& bound, int threads,
                               std::vector<double>* of_triangles) {
  const auto measure = [&](std::size_t n, SearchCounters& counters) {
    const Triangle& t = mesh.triangles[n];
    return measure_triangle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], surface, limit,
                            bound.distance, counters);
  };
  std::vector<double> values(4 * mesh.triangles.size());
  for_each_run(threads, mesh.triangles.size(), kTrianglesAtOnce,
               [&](std::size_t begin, std::size_t end) {
                 SearchCounters counters;
                 for (std::size_t n = begin; n < end; ++n) {
                   const std::array<Measure, 4> measures = measure(n, counters);
                   for (std::size_t k = 0; k < 4; ++k) values[4 * n + k] = measures[k].distance;
                 }
               });
  if (of_triangles) {
    of_triangles->clear();
    for (auto first = values.begin(); first != values.end(); first += 4) {
      of_triangles->push_back(*std::max_element(first, first + 4));
    }
  }
  return summarize(
      std::move(values), mesh, bound,
      [&](std::size_t n) {
        SearchCounters counters;
        return measure(n / 4, counters)[n % 4].at;
      },
      [](std::size_t n) { return n / 4; });
}

Distances distances_from_surface(std::span<const Vec3> samples, const CleanMesh& mesh,
                                 const TriangleTree& tree, const DistanceBound& bound,
                                 int threads) {
  if (mesh.triangles.empty()) return {};
  const std::vector<NearestTriangle> found = tree.nearest(samples, threads);
  std::vector<double> values;
  values.reserve(found.size());
  for (const NearestTriangle& nearest : found) {
    values.push_back(nearest.distance2 == kGivenUp ? kGivenUp : std::sqrt(nearest.distance2));
  }
  return summarize(
      std::move(values), mesh, bound, [&](std::size_t n) { return samples[n]; },
      [&](std::size_t n) { return found[n].triangle; });
}

BoundaryDistances boundary_distances(const CleanMesh& mesh, const Isosurface& surface,
                                     const Criteria& limits) {
  BoundaryDistances d;
  for (const CleanMesh::End& edge : mesh.ends) {
    ++d.edges;
    const Vec3 &a = mesh.points[edge.from], &b = mesh.points[edge.to];
    const double r = 0.5 * distance(a, b), h = distance_to_curve(a, b, surface);
    d.over_a_limit += r > limits.r_min && (h == kInfinity || h > limits[Criterion::distance] ||
                                           h > limits[Criterion::h_over_r] * r);
    if (h < kInfinity) d.max_h = std::max(d.max_h, h);
  }
  return d;
}

double distance_off_surface(const Vec3& p, const Isosurface& surface, double tolerance,
                            double limit) {
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
  const PatchAt patch(surface, p);
  double d = limit;
  for (const Vec3& direction : {gradient, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    d = std::min(d, patch.distance_along(direction, d, counters));
  }
  return d <= tolerance ? 0 : d;
}

}  // namespace deliso
