// SPDX-License-Identifier: MIT
#include "coarsen/ring.h"

#include <cmath>

namespace deliso {

bool Ring::walk(const TriMesh& mesh, FaceId first, VertexId v, bool is_boundary) {
  const auto& faces = mesh.faces;
  is_closed = !is_boundary;
  if (is_boundary) {
    for (FaceId f = first; f != kNoId;) {
      first = f;
      f = faces[f].n[kPreviousCorner[corner_index(faces[f], v)]];
    }
  }
  size = facets = 0;
  center = mesh.points[v];
  for (FaceId f = first;;) {
    if (size + 1 >= kMost) return false;
    const Face& face = faces[f];
    const int i = corner_index(face, v);
    star[facets++] = f;
    outer[size] = face.n[i];
    vertex[size] = face.v[kNextCorner[i]];
    point[size] = mesh.points[vertex[size]];
    ++size;
    f = face.n[kNextCorner[i]];
    if (f == first) break;
    if (f != kNoId) continue;
    if (is_closed) return false;
    outer[size] = kNoId;
    vertex[size] = face.v[kPreviousCorner[i]];
    point[size] = mesh.points[vertex[size]];
    ++size;
    break;
  }
  // Each cross product from the sides at the vertex, which two facets share.
  normal = {};
  Vec3 last = point[0] - center;
  for (int k = 1; k < size; ++k) {
    const Vec3 next = point[k] - center;
    normal = normal + cross(last, next);
    last = next;
  }
  if (is_closed) normal = normal + cross(last, point[0] - center);
  normal2 = length2(normal);
  return normal2 > 0;
}

void Ring::project() {
  // Two directions in the plane.
  const double nx = std::fabs(normal.x), ny = std::fabs(normal.y), nz = std::fabs(normal.z);
  const Vec3 u = nx <= ny && nx <= nz ? Vec3{0, normal.z, -normal.y}
                 : ny <= nz           ? Vec3{-normal.z, 0, normal.x}
                                      : Vec3{normal.y, -normal.x, 0};
  const Vec3 w = cross(normal, u) / std::sqrt(normal2);
  for (int k = 0; k < size; ++k) {
    x[k] = dot(point[k] - center, u);
    y[k] = dot(point[k] - center, w);
  }
}

}  // namespace deliso
