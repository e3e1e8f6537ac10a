// SPDX-License-Identifier: MIT
#include "check/compare_meshes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/text.h"
#include "base/triangle.h"
#include "check/self_intersections.h"
#include "check/triangle_tree.h"
#include "check/validity.h"

namespace deliso {
namespace {

// Points of the spread: for a triangle of mean area, and for the whole mesh, at least; and along a
// side of a triangle at most.
constexpr double kPointsPerTriangle = 4, kFewestPoints = 1e5, kMostAlongSide = 256;

// Returns points of the surface, evenly spread: each triangle is cut into n * n equal ones, of
// which these are the middles.
std::vector<Vec3> spread_over(const CleanMesh& mesh) {
  const auto corners = [&](const Triangle& t) {
    return std::array{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
  };
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners(t);
    area += length(area_normal(a, b, c));
  }
  const auto count = static_cast<double>(mesh.triangles.size());
  const double density = std::max(kPointsPerTriangle * count, kFewestPoints) / area;
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners(t);
    const double side = std::ceil(std::sqrt(density * length(area_normal(a, b, c))));
    const double n = std::clamp(side, 1.0, kMostAlongSide);
    const Vec3 u = (b - a) / n, v = (c - a) / n;
    for (double i = 0; i < n; ++i) {
      for (double j = 0; i + j < n; ++j) {
        const Vec3 corner = a + i * u + j * v;
        points.push_back(corner + (u + v) / 3);
        if (i + j + 1 < n) points.push_back(corner + 2 * (u + v) / 3);
      }
    }
  }
  return points;
}

std::vector<Vec3> used_vertices(const CleanMesh& mesh) {
  std::vector<Vec3> points;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] != kNoId) points.push_back(mesh.points[v]);
  }
  return points;
}

Distances distances_between(const CleanMesh& from, const CleanMesh& to, const TriangleTree& tree,
                            double bound, int threads) {
  if (from.triangles.empty() || to.triangles.empty()) return {};
  Distances spread = distances_from_surface(spread_over(from), to, tree, {bound, 0}, threads);
  const Distances at_vertices =
      distances_from_surface(used_vertices(from), to, tree, {bound, 0}, threads);
  if (at_vertices.max > spread.max) {
    spread.max = at_vertices.max;
    spread.furthest = at_vertices.furthest;
  }
  return spread;
}

}  // namespace

MeshComparison compare_meshes(const std::array<TriMesh, 2>& meshes, double bound, int threads) {
  MeshComparison result;
  std::array<CleanMesh, 2> clean;
  for (std::size_t n = 0; n < 2; ++n) {
    const TriMesh& mesh = meshes[n];
    MeshVerdict& verdict = result.sides[n].mesh;
    verdict.vertices = mesh.points.size();
    verdict.triangles = mesh.faces.size();
    clean[n] = check_validity(mesh, {}, MayEnd::anywhere, verdict.faults);
    verdict.topology = counts_of(mesh, clean[n]);
    report_self_intersections(mesh, clean[n], threads, verdict.faults);
  }
  for (std::size_t n = 0; n < 2; ++n) {
    const CleanMesh &from = clean[n], &to = clean[1 - n];
    const TriangleTree tree(to.points, to.triangles, threads);
    const Distances d = distances_between(from, to, tree, bound, threads);
    result.sides[n].to_other = d;
    if (!(d.max > bound)) continue;
    Faults& faults = result.sides[n].mesh.faults;
    faults.add(FaultKind::too_far, text("a point is ", d.max, " from the other mesh"), d.furthest);
    faults.add_unnamed(FaultKind::too_far, std::max<std::size_t>(d.beyond, 1) - 1);
  }
  return result;
}

}  // namespace deliso
