// SPDX-License-Identifier: MIT
#include "check/boundary_quality.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/triangle.h"
#include "contour/contour.h"
#include "isosurface/boundary_midpoint.h"

namespace deliso {
namespace {

// Returns the distance from the middle of the edge to the curve; on an edge of the box, to the
// nearer of two curves.
std::optional<double> distance_to_curve(const Vec3& a, const Vec3& b, const Isosurface& surface) {
  const Box3 box = surface.volume().box();
  const Vec3 middle = 0.5 * (a + b);
  std::optional<double> nearest;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double plane = face % 2 == 0 ? box.lo[axis] : box.hi[axis];
    // Meshes from files may be off the plane by rounding.
    const double slack = 1e-6 * box.size()[axis];
    if (std::fabs(a[axis] - plane) > slack || std::fabs(b[axis] - plane) > slack) continue;
    const auto x =
        boundary_midpoint(surface.volume(), surface.kappa(), static_cast<BoxFace>(face), a, b);
    if (x && (!nearest || distance(*x, middle) < *nearest)) nearest = distance(*x, middle);
  }
  return nearest;
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto angle = [](const Vec3& at, const Vec3& p, const Vec3& q) {
    return std::atan2(length(cross(p - at, q - at)), dot(p - at, q - at));
  };
  constexpr double kDegree = 3.14159265358979323846 / 180;
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)}) / kDegree;
}

}  // namespace

BoundaryQuality measure_boundary(const CleanMesh& mesh, const Isosurface& surface,
                                 const Criteria& limits) {
  BoundaryQuality q;
  q.min_angle = 60;
  std::uint32_t last = kNoId;
  for (const CleanMesh::End& edge : mesh.ends) {
    ++q.edges;
    const Vec3 &a = mesh.points[edge.from], &b = mesh.points[edge.to];
    const double r = 0.5 * distance(a, b);
    const bool is_small = !(r > limits.r_min);
    q.above_r_min += !is_small;
    if (const auto h = distance_to_curve(a, b, surface)) {
      q.max_h = std::max(q.max_h, *h);
      if (!is_small) {
        q.max_h_over_r = std::max(q.max_h_over_r, *h / r);
        q.over_h_over_r += *h > limits[Criterion::h_over_r] * r;
        q.over_distance += *h > limits[Criterion::distance];
      }
    } else {
      q.without_curve += !is_small;
    }
    if (edge.triangle == last) continue;
    last = edge.triangle;
    ++q.triangles;
    const Triangle& t = mesh.triangles[edge.triangle];
    const Vec3 &p0 = mesh.points[t[0]], &p1 = mesh.points[t[1]], &p2 = mesh.points[t[2]];
    const double ratio =
        distance(circumcenter(p0, p1, p2), p0) / std::sqrt(shortest_edge2(p0, p1, p2));
    const double angle = smallest_angle(p0, p1, p2);
    q.over_lambda += !(ratio <= limits[Criterion::r_over_l]);
    q.slivers += angle < kSliverDegrees;
    q.max_r_over_l = std::max(q.max_r_over_l, ratio);
    q.min_angle = std::min(q.min_angle, angle);
  }
  if (q.edges == 0) q.min_angle = 0;
  return q;
}

}  // namespace deliso
