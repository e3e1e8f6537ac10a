// SPDX-License-Identifier: MIT
#include "check/faults.h"

namespace deliso {

std::string_view name_of(FaultKind kind) {
  constexpr std::array<std::string_view, kFaultKinds> kNames{
      "vertices not finite",  "duplicate vertices",    "unused vertices",
      "degenerate triangles", "duplicate triangles",   "non-manifold edges",
      "orientation",          "non-manifold vertices", "holes",
      "self-intersections",   "vertices off surface",  "vertices on components left out",
      "missing components",   "extra components",      "different components",
      "turned components",    "turned caps",           "no volume",
      "restricted share",     "over limits",           "too far",
      "not measured"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace deliso
