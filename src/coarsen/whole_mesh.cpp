// SPDX-License-Identifier: MIT
#include "coarsen/whole_mesh.h"

#include <algorithm>

#include "base/triangle.h"

namespace deliso {
namespace {

// Length of the first piece of a line that is searched for facets.
constexpr double kFirstCells = 2;

}  // namespace

WholeMesh::WholeMesh(const TriMesh& mesh) : mesh_(mesh), cells_(mesh), normals_(mesh.faces.size()) {
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f].v;
    if (is_dead(mesh.faces[f])) continue;
    normals_[f] = area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
  }
}

FaceId WholeMesh::first_met(FaceId from, const Vec3& p, int axis, double end) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double sign = end > p[axis] ? 1 : -1;
  const double whole = sign * (end - p[axis]);
  FaceId met = kNoId;
  // Mostly a facet is near: the line grows until it meets one.
  double size = kFirstCells * cells_.cell();
  for (bool goes_on = true; goes_on && met == kNoId; size *= 2) {
    goes_on = size < whole;
    Vec3 last = p;
    last[axis] = goes_on ? p[axis] + sign * size : end;
    double nearest = std::min(size, whole);
    cells_.for_each_at(p, last, [&](FaceId f) {
      if (f == from) return;
      // p seen along the axis: on the inner side of every edge.
      const Triangle& t = mesh_.faces[f].v;
      const double facing = normals_[f][axis];
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = std::min(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const VertexId b = std::max(t[kNextCorner[i]], t[kPreviousCorner[i]]);
        const Vec3 &from_a = mesh_.points[a], &to_b = mesh_.points[b];
        const double turn =
            (to_b[u] - from_a[u]) * (p[v] - from_a[v]) - (to_b[v] - from_a[v]) * (p[u] - from_a[u]);
        const bool is_left = a == t[kNextCorner[i]] ? turn > 0 : turn <= 0;
        if (is_left != (facing > 0)) return;
      }
      const double at = sign * dot(normals_[f], mesh_.points[t[0]] - p) / facing;
      if (at > 0 && at < nearest) nearest = at, met = f;
    });
  }
  return met;
}

}  // namespace deliso
