// SPDX-License-Identifier: MIT
// The place of a volume, and of its mesh, in the world. All geometry is in the volume's scaled
// frame: sample (i, j, k) lies at (i*sx, j*sy, k*sz). A TriMesh keeps the frame of its volume; mesh
// files hold world coordinates.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/vec3.h"

namespace deliso {

// Bounds on the lengths and coordinates that are read, in any unit. Within them every product of
// the predicates stays in the range of a double (exact/predicates.h).
inline constexpr double kSmallestSpacing = 1e-20, kLargestLength = 1e30;

inline bool in_range(const Vec3& p) {
  // Written so that a NaN is out of range.
  return std::fabs(p.x) <= kLargestLength && std::fabs(p.y) <= kLargestLength &&
         std::fabs(p.z) <= kLargestLength;
}

// The anatomical frame of world coordinates, if the file names it. The axes point to the patient's
// right, anterior, superior (RAS) or left, posterior, superior (LPS).
enum class AnatomicalSpace : std::uint8_t { unknown, ras, lps };

// Returns "RAS", "LPS" or an empty string.
constexpr std::string_view short_name_of(AnatomicalSpace space) {
  return space == AnatomicalSpace::ras ? "RAS" : space == AnatomicalSpace::lps ? "LPS" : "";
}
// Returns the space with that short name; any other name is unknown.
constexpr AnatomicalSpace space_named(std::string_view name) {
  return name == "RAS"   ? AnatomicalSpace::ras
         : name == "LPS" ? AnatomicalSpace::lps
                         : AnatomicalSpace::unknown;
}

// Maps a point p of the scaled frame to the world: origin + p.x * axes[0] + p.y * axes[1] + p.z *
// axes[2], with unit axes; from_world() is its inverse. If the axes are left-handed, writers
// reverse the facets, so that normals still point to the side where f < kappa.
struct Frame {
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  AnatomicalSpace space = AnatomicalSpace::unknown;

  friend bool operator==(const Frame&, const Frame&) = default;

  Vec3 to_world(const Vec3& p) const {
    return origin + p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
  }
  Vec3 from_world(const Vec3& p) const {
    const auto& [u, v, w] = axes;
    const double determinant = dot(cross(u, v), w);
    const Vec3 q = p - origin;
    return {dot(cross(v, w) / determinant, q), dot(cross(w, u) / determinant, q),
            dot(cross(u, v) / determinant, q)};
  }
  // Returns the frame in another space: half a turn about S. Itself if one of them is unknown.
  Frame in_space(AnatomicalSpace other) const {
    constexpr AnatomicalSpace unknown = AnatomicalSpace::unknown;
    if (other == space || other == unknown || space == unknown) return *this;
    // From 0, since -0 would be text with a sign.
    const auto turned = [](const Vec3& p) { return Vec3{0 - p.x, 0 - p.y, p.z}; };
    return {turned(origin), {turned(axes[0]), turned(axes[1]), turned(axes[2])}, other};
  }
  bool left_handed() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }
};

}  // namespace deliso
