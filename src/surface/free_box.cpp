// SPDX-License-Identifier: MIT
#include "surface/free_box.h"

#include <cmath>

namespace deliso {

FreeBox FreeBox::within(const Volume& block) {
  FreeBox free;
  const Box3 box = block.box();
  const unsigned inner = block.inner_faces();
  for (int axis = 0; axis < 3; ++axis) {
    if ((inner >> (2 * axis) & 1) != 0) free.lo[axis] = std::nextafter(box.lo[axis], kFar);
    if ((inner >> (2 * axis + 1) & 1) != 0) free.hi[axis] = box.hi[axis];
  }
  return free;
}

}  // namespace deliso
