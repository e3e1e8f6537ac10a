// SPDX-License-Identifier: MIT
#include "coarsen/fans.h"

#include <cmath>

namespace deliso {
namespace {

constexpr double kMargin = 1e-10;

// Returns a direction at a right angle to the normal.
Vec3 across(const Vec3& n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  return x <= y && x <= z ? Vec3{0, n.z, -n.y} : y <= z ? Vec3{-n.z, 0, n.x} : Vec3{n.y, -n.x, 0};
}

}  // namespace

// Each facet runs around the vertex in the same direction, and all of them together once.
IdArray<VertexId, std::uint8_t> stars_that_are_fans(const TriMesh& mesh,
                                                    const IdArray<FaceId, Vec3>& normals) {
  struct Star {
    Vec3 along, across;
    int rounds = 0;  // facets that pass the direction at a right angle to `across`
    bool is_fan = true;
  };
  IdArray<VertexId, Star> stars(mesh.points.size());
  const auto for_each_facet = [&](auto&& visit) {
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      if (!is_dead(mesh.faces[f])) visit(mesh.faces[f], normals[f]);
    }
  };
  for_each_facet([&](const Face& face, const Vec3& normal) {
    for (const VertexId v : face.v) stars[v].along = stars[v].along + normal;
  });
  for (Star& star : stars) star.across = across(star.along);
  for_each_facet([&](const Face& face, const Vec3& normal) {
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v = face.v[i], a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      Star& star = stars[v];
      const Vec3& center = mesh.points[v];
      star.is_fan &= dot(normal, star.along) > kMargin * length2(star.along);
      star.is_fan &= face.n[(i + 1) % 3] != kNoId && face.n[(i + 2) % 3] != kNoId;
      star.rounds += dot(star.across, mesh.points[a] - center) < 0 &&
                     dot(star.across, mesh.points[b] - center) >= 0;
    }
  });
  IdArray<VertexId, std::uint8_t> fans(stars.size());
  for (VertexId v = 0; v < stars.size(); ++v) fans[v] = stars[v].is_fan && stars[v].rounds == 1;
  return fans;
}

}  // namespace deliso
