// SPDX-License-Identifier: MIT
#include "check/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "check/quality.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

struct PlaneOfBox {
  int axis = 0;
  bool high = false;
  double at = 0;
  double tolerance = 0;  // for vertices on it

  double off(const Vec3& p) const { return std::fabs(p[axis] - at); }
  // Returns the distance of the furthest corner; nothing if that is over the tolerance.
  std::optional<double> off(const TriMesh& mesh, const Triangle& t) const {
    const double most =
        std::max({off(mesh.points[t[0]]), off(mesh.points[t[1]]), off(mesh.points[t[2]])});
    return most <= tolerance ? std::optional(most) : std::nullopt;
  }
};

// Returns the planes of the box. If most vertices near a plane are exactly on it, the mesh was
// written in this frame. Then the others are off it, however near they are.
std::array<PlaneOfBox, 6> planes_of(const TriMesh& mesh, const Box3& box, double tolerance) {
  std::array<PlaneOfBox, 6> planes;
  for (int n = 0; n < 6; ++n) {
    const int axis = n / 2;
    const bool high = n % 2 == 1;
    PlaneOfBox plane{axis, high, (high ? box.hi : box.lo)[axis], tolerance};
    std::size_t near = 0, exact = 0;
    for (const Vec3& p : mesh.points) {
      near += plane.off(p) <= tolerance;
      exact += plane.off(p) == 0;
    }
    if (2 * exact > near) plane.tolerance = 0;
    planes[n] = plane;
  }
  return planes;
}

}  // namespace

SolidParts split_solid(const TriMesh& mesh, const Box3& box, double tolerance, Faults& faults) {
  SolidParts parts;
  parts.is_cap.resize(mesh.faces.size());
  const std::array<PlaneOfBox, 6> planes = planes_of(mesh, box, tolerance);
  std::vector<Triangle> surface, caps;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f].v;
    const auto on = std::find_if(planes.begin(), planes.end(),
                                 [&](const PlaneOfBox& p) { return p.off(mesh, t).has_value(); });
    if (on == planes.end()) {
      surface.push_back(t);
      parts.surface_id.push_back(f);
      continue;
    }
    caps.push_back(t);
    parts.is_cap[f] = true;
    const PlaneOfBox& plane = *on;
    parts.off_box = std::max(parts.off_box, *plane.off(mesh, t));
    Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    // Exact, since caps may be very thin: seen from a point outside.
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
