// SPDX-License-Identifier: MIT
#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/triangle.h"

namespace deliso {
namespace {

struct Shape {
  std::array<double, 3> edge;   // edge[i] is opposite corner i
  std::array<double, 3> angle;  // degrees
  double area, radius, r_over_l;
};

Shape shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = length(area_normal(a, b, c));
  Shape s{{distance(b, c), distance(c, a), distance(a, b)}, {}, 0.5 * twice_area, 0, 0};
  // tan = |u x v| / (u . v) is accurate for every angle; the cosine alone only where it is near 0.
  const auto degrees = [twice_area](const Vec3& u, const Vec3& v) {
    return std::atan2(twice_area, dot(u, v)) * (180 / std::numbers::pi);
  };
  s.angle = {degrees(b - a, c - a), degrees(c - b, a - b), degrees(a - c, b - c)};
  const double l = std::min({s.edge[0], s.edge[1], s.edge[2]});
  const double infinity = std::numeric_limits<double>::infinity();
  s.radius = twice_area > 0 ? s.edge[0] * s.edge[1] * s.edge[2] / (2 * twice_area) : infinity;
  s.r_over_l = twice_area > 0 ? s.radius / l : infinity;
  return s;
}

}  // namespace

MeshQuality measure_quality(const TriMesh& mesh, double lambda, double r_min) {
  MeshQuality q;
  q.faces = mesh.faces.size();
  if (mesh.faces.empty()) return q;
  q.min_angle = 180;
  q.min_edge = std::numeric_limits<double>::infinity();
  std::vector<double> ratios;
  ratios.reserve(mesh.faces.size());
  double edge_sum = 0;
  std::size_t edges = 0;

  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    const Shape s =
        shape_of(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]);
    const auto [least, most] = std::minmax_element(s.angle.begin(), s.angle.end());
    q.min_angle = std::min(q.min_angle, *least);
    q.max_angle = std::max(q.max_angle, *most);
    const auto bin = static_cast<std::size_t>(*least / (60.0 / MeshQuality::kAngleBins));
    ++q.angle_histogram[std::min(bin, MeshQuality::kAngleBins - 1)];

    ratios.push_back(s.r_over_l);
    q.degenerate_faces += !(s.area > 0);
    q.max_r_over_l = std::max(q.max_r_over_l, s.r_over_l);
    q.over_lambda += s.r_over_l > lambda;
    if (s.radius > r_min) {
      q.max_r_over_l_above_r_min = std::max(q.max_r_over_l_above_r_min, s.r_over_l);
      q.over_lambda_above_r_min += s.r_over_l > lambda;
    }
    q.max_radius = std::max(q.max_radius, s.radius);
    q.area += s.area;
    for (int i = 0; i < 3; ++i) {
      q.min_edge = std::min(q.min_edge, s.edge[i]);
      q.max_edge = std::max(q.max_edge, s.edge[i]);
      if (face.n[i] < f) continue;  // counted at the neighbor; kNoId is larger than any id
      edge_sum += s.edge[i];
      ++edges;
    }
  }
  q.mean_edge = edge_sum / static_cast<double>(edges);

  for (std::size_t i = 0; i < MeshQuality::kQuantiles.size(); ++i) {
    const double rank = std::ceil(MeshQuality::kQuantiles[i] * static_cast<double>(ratios.size()));
    const auto at = ratios.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::nth_element(ratios.begin(), at, ratios.end());
    q.r_over_l_quantiles[i] = *at;
  }
  return q;
}

double enclosed_volume(const TriMesh& mesh) {
  double sixfold = 0;
  std::vector<bool> seen(mesh.faces.size(), false);
  std::vector<FaceId> pending;
  for (FaceId start = 0; start < mesh.faces.size(); ++start) {
    if (seen[start]) continue;
    // Tetrahedra from one vertex of each component: cancellation stays within its size.
    const Vec3 apex = mesh.points[mesh.faces[start].v[0]];
    seen[start] = true;
    for (pending.assign(1, start); !pending.empty();) {
      const Face& face = mesh.faces[pending.back()];
      pending.pop_back();
      const auto& [a, b, c] = face.v;
      sixfold += sixfold_volume(apex, mesh.points[a], mesh.points[b], mesh.points[c]);
      for (const FaceId g : face.n) {
        if (g == kNoId || seen[g]) continue;
        seen[g] = true;
        pending.push_back(g);
      }
    }
  }
  return sixfold / 6;
}

}  // namespace deliso
