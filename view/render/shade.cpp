// SPDX-License-Identifier: MIT
#include "view/render/shade.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace deliso {
namespace {

// Shares of the light where nothing is seen of the sky. Colors with a meaning are darkened less.
constexpr double kDarkest = 0.4, kDarkestColored = 0.6;

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

Shader::Shader(const Subject& subject, const ProjectedMesh& projected, const Camera& camera,
               Shading shading, double edge_width, const Palette& palette,
               std::span<const SkySeen> sky)
    : mesh_(*subject.mesh),
      colors_(subject.colors),
      sky_(sky),
      projected_(projected),
      camera_(camera),
      palette_(palette),
      edge_reach_(0.5 * edge_width) {
  const auto direction = [&](double right, double up, double back) {
    return unit(right * camera.right + up * camera.up + back * camera.back);
  };
  key_ = direction(-0.5, 0.6, 0.8);
  fill_ = direction(0.8, -0.1, 0.5);
  gloss_ = direction(-0.25, 0.3, 0.9);
  if (shading == Shading::smooth) normals_ = vertex_normals(mesh_);
}

Vec3 Shader::color(FaceId face, int column, int row) const {
  const Triangle& t = mesh_.faces[face].v;
  const CornerWeights corners = corners_at(projected_, t, column, row);
  const double edge = edge_share(t, corners);
  if (edge == 1) return palette_.edge;

  Vec3 normal = unit(area_normal(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]));
  const bool outside = dot(normal, camera_.to_eye(mesh_.points[t[0]])) >= 0;
  if (!normals_.empty()) {
    const Vec3 smooth = unit(corners.share(0) * normals_[t[0]] + corners.share(1) * normals_[t[1]] +
                             corners.share(2) * normals_[t[2]]);
    if (dot(smooth, normal) > 0) normal = smooth;
  }
  Vec3 surface = lit(surface_color(face, outside), outside ? normal : -normal);
  if (!sky_.empty()) {
    double seen = 0;
    for (int i = 0; i < 3; ++i) {
      const SkySeen& s = sky_[t[static_cast<std::size_t>(i)]];
      seen += corners.share(i) * (outside ? s.outside : s.inside);
    }
    const double darkest = colors_.empty() ? kDarkest : kDarkestColored;
    surface = (darkest + (1 - darkest) * std::clamp(seen, 0.0, 1.0)) * surface;
  }
  return (1 - edge) * surface + edge * palette_.edge;
}

// The share of the sample that edges cover: what a line as wide as an edge and one as wide as a
// sample, beside it, have in common. So lines thinner than a sample are evenly weak, not broken.
// Every facet draws its own half of an edge, which ends where the surface in front does.
double Shader::edge_share(const Triangle& triangle, const CornerWeights& corners) const {
  if (edge_reach_ == 0) return 0;
  double share = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ProjectedMesh::Point& a = projected_.points[triangle[(i + 1) % 3]];
    const ProjectedMesh::Point& b = projected_.points[triangle[(i + 2) % 3]];
    const double dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    const double off = std::abs(static_cast<double>(corners.weight[i])) /
                       (std::sqrt(dx * dx + dy * dy) * static_cast<double>(ProjectedMesh::kUnit));
    share = std::max(share, std::min(off + 0.5, edge_reach_) - std::max(off - 0.5, -edge_reach_));
  }
  return share;
}

// A facet's own color is darker on the inside.
Vec3 Shader::surface_color(FaceId face, bool outside) const {
  if (colors_.empty()) return outside ? palette_.outside : palette_.inside;
  const Rgb& c = colors_[face];
  return (outside ? 1 : 0.7) / 255 *
         Vec3{static_cast<double>(c.red), static_cast<double>(c.green),
              static_cast<double>(c.blue)};
}

// A key light from the upper left, a weak one from the right, and a soft highlight; softer ones
// where colors have to be told from each other.
Vec3 Shader::lit(const Vec3& base, const Vec3& normal) const {
  const double key = std::max(0.0, dot(normal, key_));
  const double fill = std::max(0.0, dot(normal, fill_));
  const double mirrored = std::max(0.0, dot(normal, gloss_));
  const double squared = mirrored * mirrored, fourth = squared * squared;
  const double highlight = fourth * fourth * fourth * fourth * fourth * fourth;
  const Vec3 color =
      colors_.empty() ? (0.34 + 0.66 * key + 0.20 * fill) * base + 0.10 * highlight * Vec3{1, 1, 1}
                      : (0.62 + 0.38 * key + 0.12 * fill) * base + 0.04 * highlight * Vec3{1, 1, 1};
  return {std::min(color.x, 1.0), std::min(color.y, 1.0), std::min(color.z, 1.0)};
}

}  // namespace deliso
