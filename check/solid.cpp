// SPDX-License-Identifier: MIT
#include "check/solid.h"

#include <bit>

#include "base/text.h"
#include "check/quality.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// Returns the face of the box on which all corners lie; -1 if there is none.
int face_of_box(const TriMesh& mesh, const Triangle& t, const Box3& box) {
  unsigned faces = ~0u;
  for (const VertexId v : t) faces &= box_faces_at(mesh.points[v], box);
  return faces != 0 ? std::countr_zero(faces) : -1;
}

}  // namespace

SolidParts split_solid(const TriMesh& mesh, const Box3& box, Faults& faults) {
  SolidParts parts;
  parts.is_cap.resize(mesh.faces.size());
  std::vector<Triangle> surface, caps;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f].v;
    const int on = face_of_box(mesh, t, box);
    if (on < 0) {
      surface.push_back(t);
      parts.surface_id.push_back(f);
      continue;
    }
    caps.push_back(t);
    parts.is_cap[f] = true;
    const int axis = on / 2;
    Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    // Exact, since caps may be very thin: seen from a point outside.
    a[axis] = b[axis] = c[axis] = 0;
    Vec3 eye = a;
    eye[axis] = on % 2 == 1 ? 1 : -1;
    if (orient3d(a, b, c, eye) < 0) {
      faults.add(
          FaultKind::turned_caps,
          text("triangle ", f, " (", t[0], " ", t[1], " ", t[2], ") on the box faces into it"),
          (a + b + c) / 3);
    }
  }
  parts.surface = make_tri_mesh(mesh.points, surface);
  parts.caps = make_tri_mesh(mesh.points, caps);
  parts.volume = enclosed_volume(mesh);
  if (!mesh.faces.empty() && !(parts.volume > 0)) {
    faults.add(FaultKind::no_volume, text("the triangles enclose a volume of ", parts.volume),
               mesh.points[mesh.faces[0].v[0]]);
  }
  return parts;
}

}  // namespace deliso
