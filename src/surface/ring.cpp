// SPDX-License-Identifier: MIT
#include "surface/ring.h"

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
  center = mesh.points[v];
  int n = 0;
  FaceId f = first;
  do {
    if (n + 1 >= kMost) return false;
    const Face& face = faces[f];
    const int i = corner_index(face, v);
    star[n] = f;
    outer[n] = face.n[i];
    vertex[n] = face.v[kNextCorner[i]];
    point[n] = mesh.points[vertex[n]];
    ++n;
    f = face.n[kNextCorner[i]];
  } while (f != first && f != kNoId);
  facets = size = n;
  if (f == kNoId) {
    if (is_closed) return false;
    const Face& face = faces[star[n - 1]];
    outer[n] = kNoId;
    vertex[n] = face.v[kPreviousCorner[corner_index(face, v)]];
    point[n] = mesh.points[vertex[n]];
    size = n + 1;
  }
  // Each cross product from the sides at the vertex, which two facets share.
  const Vec3 side = point[0] - center;
  Vec3 sum, last = side;
  for (int k = 1; k < size; ++k) {
    const Vec3 next = point[k] - center;
    sum = sum + cross(last, next);
    last = next;
  }
  normal = is_closed ? sum + cross(last, side) : sum;
  normal2 = length2(normal);
  return normal2 > 0;
}

void Ring::project() {
  // Two directions in the plane, without branches (Duff et al. 2017).
  const Vec3 n = normal / std::sqrt(normal2);
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const Vec3 u{1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  const Vec3 w{b, sign + n.y * n.y * a, -n.y};
  for (int k = 0; k < size; ++k) {
    x[k] = dot(point[k] - center, u);
    y[k] = dot(point[k] - center, w);
  }
}

}  // namespace deliso
