// SPDX-License-Identifier: MIT
// Edge flips by the Delaunay test of Stage 2, by surface balls: the two facets at an edge give way
// to the two across the other diagonal when one of them has the other's corner in its ball and the
// new ones have not. What falls is the sum of the balls' radii: in the plane Delaunay flips lower
// it (Musin 1997), on a surface they need not and would go round in circles.
#pragma once

#include "refine/replace_disk.h"

namespace deliso {

class Flipper {
 public:
  // Keeps references.
  Flipper(SurfaceMesh& surface_mesh, DiskReplacer& replacer)
      : s_(surface_mesh), replacer_(replacer) {}

  // Flips the edge of f opposite its corner i, when that is called for and allowed.
  bool flip_if_not_delaunay(FaceId f, int i);
  std::span<const FaceId> created() const { return change_.created; }

 private:
  SurfaceMesh& s_;
  DiskReplacer& replacer_;
  Change change_;
};

}  // namespace deliso
