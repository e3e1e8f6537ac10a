// SPDX-License-Identifier: MIT
// A change of the mesh as Stage 2 proposes it: a disk of facets, and another one in its place.
#pragma once

#include <vector>

#include "refine/patch.h"
#include "surface/surface_mesh.h"

namespace deliso {

struct Change {
  std::vector<FaceId> out;
  Patch was;  // their corners, by mark_old()
  Patch in;
  // A vertex that comes, or is moved, and to where.
  enum class Vertex { none, comes, moves } what = Vertex::none;
  VertexId vertex = kNoId;  // when it comes, the mesh's vertex count
  Vec3 place;
  double least_cosine = -1;  // G2: between the normals at an edge; -1: not asked
  // The disk lies in a face of the box and is to leave it, wherever Sigma is: G3 is not asked, and
  // a component flat in that face, which bounds nothing yet, may be turned either way.
  bool leaves_box = false;
  // Found on the way.
  std::vector<Dual> duals;      // of `in`
  std::vector<FaceId> created;  // of `in`, once it is done
};

}  // namespace deliso
