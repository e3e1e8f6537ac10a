// SPDX-License-Identifier: MIT
// Where a volume, and a mesh made from it, lies in the world. All geometry runs in the volume's
// scaled frame (sample (i, j, k) at (i*sx, j*sy, k*sz)); a TriMesh carries its volume's frame
// along, and files of meshes hold world coordinates.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/vec3.h"

namespace deliso {

// What lengths and coordinates that are read may be in size, in any unit: narrow enough that every
// product of the predicates stays in the range of a double (delaunay/predicates.h).
inline constexpr double kSmallestSpacing = 1e-20, kLargestLength = 1e30;

inline bool in_range(const Vec3& p) {
  // A NaN is in no range.
  return std::fabs(p.x) <= kLargestLength && std::fabs(p.y) <= kLargestLength &&
         std::fabs(p.z) <= kLargestLength;
}

// The anatomical frame of world coordinates, where the file names it: axes to the patient's right,
// anterior, superior (RAS) or left, posterior, superior (LPS).
enum class AnatomicalSpace : std::uint8_t { unknown, ras, lps };

// "RAS", "LPS", or nothing.
constexpr std::string_view short_name_of(AnatomicalSpace space) {
  return space == AnatomicalSpace::ras ? "RAS" : space == AnatomicalSpace::lps ? "LPS" : "";
}

// World position of a point p of the scaled frame: origin + p.x * axes[0] + p.y * axes[1] + p.z *
// axes[2], with unit axes. The axes may be left-handed; writers then turn the triangles round, so
// that normals keep pointing to the side where f < kappa.
struct Frame {
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  AnatomicalSpace space = AnatomicalSpace::unknown;

  friend bool operator==(const Frame&, const Frame&) = default;

  Vec3 to_world(const Vec3& p) const {
    return origin + p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
  }
  bool left_handed() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }
};

}  // namespace deliso
