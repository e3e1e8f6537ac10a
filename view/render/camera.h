// SPDX-License-Identifier: MIT
// A camera, upright: one of the axes, +z by default, is up in the picture. It is infinitely far
// away (parallel projection), or as near as an angle of view asks for (perspective).
//
//   C1  Right, up and back are orthonormal and right-handed. Back points to the eye.
//   C2  Picture coordinates are in pixels, x to the right and y down, (0, 0) at the top left.
//   C3  Depth is larger nearer to the eye, and linear over the picture of a facet. In parallel
//       projection it is in the mesh's units.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "mesh/tri_mesh.h"
#include "view/render/image.h"
#include "view/render/layout.h"

namespace deliso {

// The axis that points up in a picture, and its sign, 1 or -1.
struct Up {
  int axis = 2;
  double sign = 1;
  friend constexpr bool operator==(const Up&, const Up&) = default;
};

// The direction of the eye, in degrees: azimuth from +x towards +y, elevation above the xy plane.
// It is then rotated so that +z becomes `up`, and +x the axis after it.
struct View {
  double azimuth = 0, elevation = 0;
  Up up = {};
  friend constexpr bool operator==(const View&, const View&) = default;
};

Vec3 direction_to(const View& view);  // of unit length

// Only what has dot(normal, p) <= offset is drawn.
struct ClipPlane {
  Vec3 normal;
  double offset = 0;

  double height(const Vec3& p) const { return dot(normal, p) - offset; }
};

// A mesh, the part of it to be drawn, and the colors of its facets, the palette's where there are
// none. Keeps a pointer to the mesh and views of the rest.
struct Subject {
  const TriMesh* mesh;
  std::optional<ClipPlane> clip;
  std::span<const Rgb> colors = {};
  std::span<const std::uint8_t> framed = {};  // of facets: what a camera is to show; empty: all
  // The gray, from 0 to 1, of a place on the clipping plane, or nothing where the cut is open.
  std::function<std::optional<double>(const Vec3&)> section = {};
};

struct Camera {
  Vec3 right, up, back;
  Vec3 center;          // is seen in the middle of the picture
  double scale = 1;     // pixels per unit of length at the center
  double nearness = 0;  // 1 / the distance of the eye from the center; 0: infinitely far away
  PictureSize size;

  struct Projected {
    double x, y, depth;
    double magnified;  // how many times larger than at the center; linear over a facet's picture
  };
  Projected project(const Vec3& p) const {
    const Vec3 d = p - center;
    const double toward = dot(back, d), magnified = 1 / (1 - nearness * toward);
    return {0.5 * size.width + magnified * scale * dot(right, d),
            0.5 * size.height - magnified * scale * dot(up, d), magnified * toward, magnified};
  }
  // Returns the direction from p to the eye; as long as `back` at the center's depth.
  Vec3 to_eye(const Vec3& p) const { return back - nearness * (p - center); }
  // Returns the place on the plane that is seen there; nothing if the plane is seen from its edge,
  // or is not before the eye.
  std::optional<Vec3> place_on(const ClipPlane& plane, double x, double y) const {
    const Vec3 p =
        center + (x - 0.5 * size.width) / scale * right - (y - 0.5 * size.height) / scale * up;
    const Vec3 ray = to_eye(p);
    const double across = dot(plane.normal, ray), along = -plane.height(p) / across;
    if (across == 0 || nearness * along >= 1) return std::nullopt;
    return p + along * ray;
  }
};

// How a camera is aimed.
struct Aim {
  double zoom = 1;              // 1: what is seen fills the picture
  std::optional<Vec3> look_at;  // in the middle of the picture; absent: the middle of what is seen
  double angle = 0;             // of view, in degrees: of a ball around all; 0: parallel projection
};

// Returns a camera that shows all unclipped corners of the subjects' framed facets, with a narrow
// margin, and is then aimed. Throws InputError if all corners are clipped, if they are too large
// for the arithmetic, or if look_at is beside all of them.
Camera fit_camera(std::span<const Subject> subjects, const View& view, const Aim& aim,
                  PictureSize size);

}  // namespace deliso
