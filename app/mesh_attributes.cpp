// SPDX-License-Identifier: MIT
#include "app/mesh_attributes.h"

#include <algorithm>
#include <cmath>

#include "app/facet_values.h"
#include "base/triangle.h"
#include "check/distances.h"

namespace deliso {
namespace {

// Returns the sums of the facets' normals, weighted by area. The facets of caps count only at
// vertices from `first_cap_vertex` on.
IdArray<VertexId, Vec3> facet_normals(const TriMesh& mesh, std::size_t first_cap,
                                      std::size_t first_cap_vertex) {
  IdArray<VertexId, Vec3> sums(mesh.points.size(), Vec3{});
  for (FaceId f(0); f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f].v;
    const Vec3 normal = area_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    for (const VertexId v : t) {
      if (f < first_cap || v >= first_cap_vertex) sums[v] = sums[v] + normal;
    }
  }
  return sums;
}

std::vector<std::array<float, 3>> normals(const TriMesh& mesh, const Volume& volume,
                                          std::size_t first_cap, std::size_t first_cap_vertex) {
  const auto sums = facet_normals(mesh, first_cap, first_cap_vertex);
  std::vector<std::array<float, 3>> result;
  result.reserve(mesh.points.size());
  for (VertexId v(0); v < mesh.points.size(); ++v) {
    Vec3 normal = -volume.gradient(mesh.points[v]);
    if (v >= first_cap_vertex || !(dot(normal, sums[v]) > 0)) normal = sums[v];
    normal = normal_in_world(normal, mesh.frame);
    const double size = length(normal);
    const bool usable = size > 0 && std::isfinite(size);
    const Vec3 unit = usable ? normal / size : Vec3{0, 0, 1};
    result.push_back(
        {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)});
  }
  return result;
}

}  // namespace

Vec3 normal_in_world(const Vec3& normal, const Frame& frame) {
  const auto& [u, v, w] = frame.axes;
  const Vec3 mapped = normal.x * cross(v, w) + normal.y * cross(w, u) + normal.z * cross(u, v);
  return frame.left_handed() ? -mapped : mapped;
}

MeshAttributes mesh_attributes(const TriMesh& mesh, const TriMesh& surface, const Volume& volume,
                               const Report& report, int threads) {
  const bool has_caps = surface.faces.size() < mesh.faces.size();
  MeshAttributes attributes;
  attributes.normals = normals(mesh, volume, surface.faces.size(),
                               has_caps ? report.cap.surface_vertices : mesh.points.size());
  attributes.component = facet_components(mesh).of_facet;
  const double limit = kSearchDiagonals * length(volume.spacing());
  for (const double d : facet_distances(surface, volume, report.kappa_effective, threads)) {
    attributes.distance.push_back(static_cast<float>(std::min(d, limit)));
  }
  attributes.distance.resize(mesh.faces.size(), 0);
  return attributes;
}

}  // namespace deliso
