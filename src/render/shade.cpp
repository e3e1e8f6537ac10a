// SPDX-License-Identifier: MIT
#include "render/shade.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace deliso {
namespace {

Vec3 unit(const Vec3& v) {
  const double size = length(v);
  return size > 0 ? v / size : Vec3{};
}

}  // namespace

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const Face& face : mesh.faces) {
    const Vec3 normal =
        area_normal(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]);
    for (const VertexId v : face.v) normals[v] = normals[v] + normal;
  }
  for (Vec3& normal : normals) normal = unit(normal);
  return normals;
}

Shader::Shader(const TriMesh& mesh, const ProjectedMesh& projected, const Camera& camera,
               Shading shading, double edge_width, const Palette& palette)
    : mesh_(mesh),
      projected_(projected),
      camera_(camera),
      palette_(palette),
      edge_reach_(0.5 * edge_width * static_cast<double>(ProjectedMesh::kUnit)) {
  const auto direction = [&](double right, double up, double back) {
    return unit(right * camera.right + up * camera.up + back * camera.back);
  };
  key_ = direction(-0.5, 0.6, 0.8);
  fill_ = direction(0.8, -0.1, 0.5);
  gloss_ = direction(-0.25, 0.3, 0.9);
  if (shading == Shading::smooth) normals_ = vertex_normals(mesh);
}

Vec3 Shader::color(FaceId face, int column, int row) const {
  const Triangle& t = mesh_.faces[face].v;
  const CornerWeights corners = corners_at(projected_, t, column, row);
  const double edge = edge_strength(t, corners);
  if (edge == 1) return palette_.edge;

  Vec3 normal = unit(area_normal(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]));
  const bool outside = dot(normal, camera_.back) >= 0;
  if (!normals_.empty()) {
    const Vec3 smooth = unit(corners.share(0) * normals_[t[0]] + corners.share(1) * normals_[t[1]] +
                             corners.share(2) * normals_[t[2]]);
    if (dot(smooth, normal) > 0) normal = smooth;
  }
  const Vec3 surface =
      lit(outside ? palette_.outside : palette_.inside, outside ? normal : -normal);
  return (1 - edge) * surface + edge * palette_.edge;
}

// From 0, off the edges, to 1. Every facet draws its own half of an edge, so the edge ends where
// the surface in front does. Edges fade where facets are so small that little else would be left.
double Shader::edge_strength(const Triangle& triangle, const CornerWeights& corners) const {
  constexpr double kFullInradius = 6;  // in reaches
  if (edge_reach_ == 0) return 0;
  double perimeter = 0;
  bool near = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const ProjectedMesh::Point& a = projected_.points[triangle[(i + 1) % 3]];
    const ProjectedMesh::Point& b = projected_.points[triangle[(i + 2) % 3]];
    const double dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    const double side = std::sqrt(dx * dx + dy * dy);
    perimeter += side;
    near = near || std::abs(static_cast<double>(corners.weight[i])) < edge_reach_ * side;
  }
  if (!near) return 0;
  const double inradius = std::abs(static_cast<double>(corners.area)) / perimeter;
  return std::min(1.0, inradius / (kFullInradius * edge_reach_));
}

// A key light from the upper left, a weak one from the right, and a soft highlight.
Vec3 Shader::lit(const Vec3& base, const Vec3& normal) const {
  const double key = std::max(0.0, dot(normal, key_));
  const double fill = std::max(0.0, dot(normal, fill_));
  const double mirrored = std::max(0.0, dot(normal, gloss_));
  const double squared = mirrored * mirrored, fourth = squared * squared;
  const double highlight = fourth * fourth * fourth * fourth * fourth * fourth;
  const Vec3 color = (0.34 + 0.66 * key + 0.20 * fill) * base + 0.10 * highlight * Vec3{1, 1, 1};
  return {std::min(color.x, 1.0), std::min(color.y, 1.0), std::min(color.z, 1.0)};
}

}  // namespace deliso
