// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isosurface/isosurface.h"

namespace deliso {

// The surface in a box of a volume, which it keeps.
struct BoxSurface {
  BoxSurface(Volume of_box, double kappa) : volume(std::move(of_box)), surface(volume, kappa) {}
  BoxSurface(const BoxSurface&) = delete;

  Volume volume;
  Isosurface surface;
};

}  // namespace deliso
