// SPDX-License-Identifier: MIT
#include "view/render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/box3.h"
#include "base/check.h"
#include "base/vec2.h"

namespace deliso {
namespace {

constexpr double kViewMargin = 0.03;  // of the picture, on each side

constexpr double kDegree = std::numbers::pi / 180;

// By the rotation that takes +z to `up`.
Vec3 rotated(const Vec3& p, const Up& up) {
  Vec3 q;
  q[(up.axis + 1) % 3] = p.x;
  q[(up.axis + 2) % 3] = up.sign * p.y;
  q[up.axis] = up.sign * p.z;
  return q;
}

Camera look_from(const View& view) {
  Camera camera;
  camera.back = direction_to(view);
  camera.right =
      rotated({-std::sin(view.azimuth * kDegree), std::cos(view.azimuth * kDegree), 0}, view.up);
  camera.up = cross(camera.back, camera.right);
  return camera;
}

// A point in coordinates along the camera's axes.
Vec3 along_axes(const Camera& camera, const Vec3& p) {
  return {dot(camera.right, p), dot(camera.up, p), dot(camera.back, p)};
}

// Calls visit(p) for the unclipped corners of framed facets.
template <class Visit>
void for_seen_corners(std::span<const Subject> subjects, Visit&& visit) {
  for (const Subject& subject : subjects) {
    const auto& faces = subject.mesh->faces;
    for (FaceId f = 0; f < faces.size(); ++f) {
      if (!subject.framed.empty() && subject.framed[f] == 0) continue;
      for (const VertexId v : faces[f].v) {
        const Vec3& p = subject.mesh->points[v];
        if (!subject.clip || subject.clip->height(p) <= 0) visit(p);
      }
    }
  }
}

// Returns the bounding box, along the camera's axes, of what is seen.
Box3 seen_box(std::span<const Subject> subjects, const Camera& camera) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for_seen_corners(subjects, [&](const Vec3& p) {
    const Vec3 q = along_axes(camera, p);
    box = united(box, {q, q});
  });
  return box;
}

// Returns 1 / the distance of an eye that sees a ball around what is seen within the angle. It is
// before all facets, also those that are clipped or not framed.
double nearness(std::span<const Subject> subjects, const Camera& camera, double angle) {
  constexpr double kBefore = 1.05;
  double radius2 = 0, nearest = 0;
  for_seen_corners(
      subjects, [&](const Vec3& p) { radius2 = std::max(radius2, distance2(p, camera.center)); });
  for (const Subject& subject : subjects) {
    for (const Face& face : subject.mesh->faces) {
      for (const VertexId v : face.v) {
        nearest = std::max(nearest, dot(camera.back, subject.mesh->points[v] - camera.center));
      }
    }
  }
  const double eye =
      std::max(std::sqrt(radius2) / std::sin(0.5 * angle * kDegree), kBefore * nearest);
  return eye > 0 ? 1 / eye : 0;
}

// Returns the sides of the smallest rectangle around the center, at its depth, that hides all that
// is seen.
Vec2 magnified_reach(std::span<const Subject> subjects, const Camera& camera) {
  Vec2 reach;
  for_seen_corners(subjects, [&](const Vec3& p) {
    const Vec3 d = p - camera.center;
    const double twice = 2 / (1 - camera.nearness * dot(camera.back, d));
    reach = {std::max(reach.x, twice * std::fabs(dot(camera.right, d))),
             std::max(reach.y, twice * std::fabs(dot(camera.up, d)))};
  });
  return reach;
}

}  // namespace

Vec3 direction_to(const View& view) {
  const double ca = std::cos(view.azimuth * kDegree), sa = std::sin(view.azimuth * kDegree);
  const double ce = std::cos(view.elevation * kDegree), se = std::sin(view.elevation * kDegree);
  return rotated({ce * ca, ce * sa, se}, view.up);
}

Camera fit_camera(std::span<const Subject> subjects, const View& view, const Aim& aim,
                  PictureSize size) {
  Camera camera = look_from(view);
  camera.size = size;
  const Box3 box = seen_box(subjects, camera);
  if (!(box.lo.x <= box.hi.x)) {
    const bool empty = std::all_of(subjects.begin(), subjects.end(),
                                   [](const Subject& s) { return s.mesh->faces.empty(); });
    throw InputError(empty ? "there is nothing to draw: the mesh has no facets"
                           : "there is nothing to draw: all is clipped");
  }
  const Vec3 middle = box.middle(), sides = box.size();
  camera.center = middle.x * camera.right + middle.y * camera.up + middle.z * camera.back;
  if (aim.angle > 0) camera.nearness = nearness(subjects, camera, aim.angle);
  const double room = 1 - 2 * kViewMargin;
  const Vec2 reach = aim.angle > 0 ? magnified_reach(subjects, camera) : Vec2{sides.x, sides.y};
  const double units_per_pixel =
      std::max(reach.x / (room * size.width), reach.y / (room * size.height));
  camera.scale = units_per_pixel > 0 ? aim.zoom / units_per_pixel : aim.zoom;
  if (!std::isfinite(length2(sides)) || !std::isfinite(length2(camera.center)) ||
      !std::isfinite(camera.scale)) {
    throw InputError("the mesh is too large or too small to draw");
  }
  if (aim.look_at) {
    const Vec3 target = along_axes(camera, *aim.look_at);
    // Farther away, coordinates in the picture could outgrow rasterize.h's bound.
    if (target.x < box.lo.x || target.x > box.hi.x || target.y < box.lo.y || target.y > box.hi.y) {
      throw InputError("the point to look at is beside all that is drawn");
    }
    // The eye moves with the center, and as far from all as it was.
    const double off = camera.nearness > 0 ? dot(camera.back, *aim.look_at - camera.center) : 0;
    camera.center = *aim.look_at - off * camera.back;
  }
  return camera;
}

}  // namespace deliso
