// SPDX-License-Identifier: MIT
#include "check/solid.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/text.h"
#include "delaunay/predicates.h"
#include "mesh/quality.h"

namespace deliso {
namespace {

struct PlaneOfBox {
  int axis = 0;
  bool high = false;
  double off = 0;  // the furthest of the corners
};

// The face of the box that all corners lie on; `found` is set when there is one.
PlaneOfBox face_of(const TriMesh& mesh, const Triangle& t, const Box3& box, double tolerance,
                   bool& found) {
  found = false;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      const double plane = high ? box.hi[axis] : box.lo[axis];
      double off = 0;
      for (const VertexId v : t) off = std::max(off, std::fabs(mesh.points[v][axis] - plane));
      if (!(off <= tolerance)) continue;
      found = true;
      return {axis, high, off};
    }
  }
  return {};
}

}  // namespace

SolidParts part_solid(const TriMesh& mesh, const Box3& box, double tolerance, Faults& faults) {
  SolidParts parts;
  parts.is_cap.resize(mesh.faces.size());
  std::vector<Triangle> surface, caps;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f].v;
    bool on_box = false;
    const PlaneOfBox plane = face_of(mesh, t, box, tolerance, on_box);
    if (!on_box) {
      surface.push_back(t);
      parts.surface_id.push_back(f);
      continue;
    }
    caps.push_back(t);
    parts.is_cap[f] = true;
    parts.off_box = std::max(parts.off_box, plane.off);
    Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    // Exactly, since caps may be very thin: seen from a point outside.
    a[plane.axis] = b[plane.axis] = c[plane.axis] = 0;
    Vec3 eye = a;
    eye[plane.axis] = plane.high ? 1 : -1;
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
