// SPDX-License-Identifier: MIT
#include "app/bring_home.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/predicates.h"
#include "io/files/text_scan.h"
#include "io/mesh/to_float.h"

namespace deliso {
namespace {

// True if x is a float, or what a text has for one: the decimal with the fewest digits that is
// nearest to this float and to no other.
bool is_float(double x) {
  if (to_float(x) == x) return true;
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, static_cast<float>(x));
  return to_double({text, end.ptr}) == x;
}

}  // namespace

bool is_single_precision(const TriMesh& mesh) {
  return std::ranges::all_of(
      mesh.points, [](const Vec3& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
}

double bring_home(TriMesh& mesh, const Frame& volume) {
  const Frame at = volume.in_space(mesh.frame.space);
  double largest = 0;
  const bool single = is_single_precision(mesh);
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(p[axis]));
    p = at.from_world(p);  // exact where the frames are the same
  }
  // Coordinates too small for the predicates are far below all rounding.
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::fabs(p[axis]) < kSmallestCoordinate) p[axis] = 0;
    }
  }
  if (at.left_handed()) {
    for (Face& face : mesh.faces) std::swap(face.v[1], face.v[2]);
  }
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  constexpr double kFloatRounding = std::numeric_limits<float>::epsilon();
  return largest * (16 * kRounding + (single ? kFloatRounding : 0));
}

}  // namespace deliso
