// SPDX-License-Identifier: MIT
#include "check/distances.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/triangle.h"
#include "isosurface/boundary_midpoint.h"
#include "isosurface/patch_at.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the uses of the edges whose first use is at begin to end - 1: so runs of all uses become
// runs of whole edges.
std::span<const EdgeUse> edges_within(std::span<const EdgeUse> uses, std::size_t begin,
                                      std::size_t end) {
  const auto first_of_edge = [&](std::size_t n) {
    while (n > 0 && n < uses.size() && is_same_edge(uses[n - 1], uses[n])) ++n;
    return n;
  };
  begin = first_of_edge(begin);
  return uses.subspan(begin, first_of_edge(end) - begin);
}

constexpr std::size_t kTrianglesAtOnce = 1u << 10, kUsesAtOnce = 1u << 11;

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
      ++d.given_up;  // unreachable: quick tests are too small
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
  const unsigned faces = box_faces_at(a, box) & box_faces_at(b, box);
  for (int face = 0; face < 6; ++face) {
    if ((faces >> face & 1) == 0) continue;
    const auto x =
        boundary_midpoint(surface.volume(), surface.kappa(), static_cast<BoxFace>(face), a, b);
    if (x) nearest = std::min(nearest, distance(*x, 0.5 * (a + b)));
  }
  return nearest;
}

// The search for Sigma on lines through a point, which may be of several triangles.
class LinesThrough {
 public:
  // `corner`: the line to it is searched for all triangles.
  LinesThrough(const Isosurface& surface, const Vec3& p, const Vec3& corner, double limit,
               double bound)
      : p_(p),
        corner_(corner),
        patch_(surface, p),
        near_(std::min({bound, limit / 8, surface.volume().voxel()})),
        steep_(std::fabs(patch_.parameter_along(patch_.gradient(), limit, counters_))),
        limit_(std::min(limit, steep_)) {}

  // Returns the distance that a triangle of this normal has here. `others`: more corners.
  double distance(const Vec3& normal, std::initializer_list<Vec3> others) {
    // A search is limited by the hits before.
    double d = std::min(steep_, along(normal, limit_));
    if (d <= near_) return d;
    // Both may miss a thin or small piece of Sigma.
    if (!common_) {
      common_ = kInfinity;
      for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, corner_ - p_}) {
        common_ = std::min(*common_, along(direction, std::min(limit_, *common_)));
      }
    }
    d = std::min(d, *common_);
    for (const Vec3& other : others) {
      d = std::min(d, along(other - p_, std::min(limit_, d)));
    }
    return d;
  }

 private:
  double along(const Vec3& direction, double limit) {
    return std::fabs(patch_.parameter_along(direction, limit, counters_));
  }

  SearchCounters counters_;
  const Vec3 p_, corner_;
  const PatchAt patch_;
  const double near_;
  const double steep_;  // along the gradient
  const double limit_;
  std::optional<double> common_;  // along the axes and to the common corner
};

// Point 0 of a triangle is its middle, the others are those of its sides.
std::size_t point_of_side(std::size_t side) {
  return 1 + (side + 1) % 3;
}

}  // namespace

Vec3 measured_point(const CleanMesh& mesh, std::size_t triangle, std::size_t point) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const std::array<Vec3, 3> at{mesh.points[a], mesh.points[b], mesh.points[c]};
  return point == 0 ? (at[0] + at[1] + at[2]) / 3 : 0.5 * (at[point - 1] + at[point % 3]);
}

Distances distances_to_surface(const CleanMesh& mesh, const Isosurface& surface, double limit,
                               const DistanceBound& bound, int threads,
                               std::vector<TriangleDistances>* of_triangles) {
  const auto normal = [&](std::size_t n) {
    const auto& [a, b, c] = mesh.triangles[n];
    return area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
  };
  std::vector<double> values(4 * mesh.triangles.size());
  for_each_run(threads, mesh.triangles.size(), kTrianglesAtOnce,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t n = begin; n < end; ++n) {
                   const auto& [a, b, c] = mesh.triangles[n];
                   LinesThrough lines(surface, measured_point(mesh, n, 0), mesh.points[a], limit,
                                      bound.distance);
                   values[4 * n] = lines.distance(normal(n), {mesh.points[b], mesh.points[c]});
                 }
               });
  // The middle of an edge is searched once for its triangles.
  for_each_run(threads, mesh.uses.size(), kUsesAtOnce, [&](std::size_t begin, std::size_t end) {
    for_each_edge(edges_within(mesh.uses, begin, end), [&](std::span<const EdgeUse> edge) {
      const Vec3 &p = mesh.points[edge[0].lo], &q = mesh.points[edge[0].hi];
      LinesThrough lines(surface, 0.5 * (p + q), p, limit, bound.distance);
      for (const EdgeUse& use : edge) {
        const Vec3& opposite = mesh.points[mesh.triangles[use.triangle][use.side]];
        values[std::size_t{4} * use.triangle + point_of_side(use.side)] =
            lines.distance(normal(use.triangle), {opposite});
      }
      return true;
    });
  });
  if (of_triangles) {
    of_triangles->resize(mesh.triangles.size());
    for (std::size_t n = 0; n < values.size(); ++n) (*of_triangles)[n / 4][n % 4] = values[n];
  }
  return summarize(
      std::move(values), mesh, bound,
      [&](std::size_t n) { return measured_point(mesh, n / 4, n % 4); },
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
  // Lines from a point outside may pass the box by, however near it is.
  const Box3 box = volume.box();
  Vec3 inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside[axis] = std::clamp(p[axis], box.lo[axis], box.hi[axis]);
  }
  const double outside = distance(p, inside);
  const Corners corners = volume.corners(volume.voxel_at(inside));
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  const double difference = std::fabs(volume.value(inside) - surface.kappa());
  const Vec3 gradient = surface.gradient(inside);
  if (outside == 0 &&
      (difference <= 1e-9 * (*most - *least) || difference <= tolerance * length(gradient))) {
    return 0;
  }
  Vec3 in_face = gradient;  // the other may lead out of the box
  for (int axis = 0; axis < 3; ++axis) {
    if (inside[axis] == box.lo[axis] || inside[axis] == box.hi[axis]) in_face[axis] = 0;
  }
  if (in_face == gradient) in_face = {};
  SearchCounters counters;
  const PatchAt patch(surface, inside);
  double d = limit;
  for (const Vec3& direction : {gradient, in_face, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    if (!(length2(direction) > 0)) continue;
    d = std::min(d, outside + std::fabs(patch.parameter_along(direction, d, counters)));
  }
  return d <= tolerance ? 0 : d;
}

}  // namespace deliso
