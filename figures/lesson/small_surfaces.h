// SPDX-License-Identifier: MIT
// Small surfaces with labels, each of which breaks one condition of the certificate alone, and
// their duals: docs/proof.md (Theorem 2). On paper they are drawn without their height.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace deliso::lesson {

struct Labeled {
  std::vector<Vec3> points;
  std::string labels;  // per point
  std::vector<std::array<int, 3>> triangles;
  // On paper the last triangle is the outside of the others: the surface is a sphere.
  bool is_sphere = false;
};

struct SmallSurface {
  const char *title, *above, *below;  // the condition; what breaks it; what K is
  Labeled t, k;
  std::vector<std::array<int, 2>> wrong;  // edges of K, or a vertex twice
  // On the page, where the fault is on T: pairs of labels whose patches meet there; '-' is the
  // outside.
  const char* marks;
};

std::vector<SmallSurface> small_surfaces();

}  // namespace deliso::lesson
