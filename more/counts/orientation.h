// SPDX-License-Identifier: MIT
// Keeps the orientation of components, and the side on which each lies of every other, while
// vertices are merged. Gate G2 tests components of few facets only (refine/refinement.h), and a
// mesh may be coarsened to its last vertices.
//
// Two quantities keep their signs: the volume that a closed component bounds, and the area that a
// boundary loop encloses if it lies within one face of the box. Each is a sum over facets or edges,
// so a merge changes it by what it replaces. A loop that passes from one face of the box to another
// needs no test: its vertices on the edges of the box stay, and with them the side of the loop
// (docs/proof.md, 4.4).
//
// A merge sweeps from the old facets to the new ones. Gate G5 looks at the new ones alone, which
// may lie behind a small component as a whole. One that is swept over in part crosses a new facet,
// so one vertex of each component is tested.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/refinement.h"

namespace deliso {

class Orientation {
 public:
  explicit Orientation(const Refinement& r);

  // True if a merge of `from`, with this star, into a vertex at `to` changes a sign, or its move
  // there, if it is not on the boundary.
  bool reverses(std::span<const FaceId> star, VertexId from, const Vec3& to);
  // True if such a merge or move sweeps over another component.
  bool passes_component(const Disk& star, VertexId from, const Vec3& to) const;
  // pre: this merge was the last one asked, and was done; of a move `to` is `from`.
  void merged(VertexId from, VertexId to);

 private:
  struct Loop {
    int axis = -1;    // normal to the face of the box; -1 if the loop passes an edge of the box
    double area = 0;  // twice
  };
  struct Component {
    bool is_closed = true;
    Vec3 origin;              // one of its points, for accuracy
    double volume = 0;        // six times
    VertexId vertex = kNoId;  // one of its vertices
  };

  void add_loop(VertexId start);
  double volume_from(const Vec3& origin, const Triangle& v) const;

  const Refinement& r_;
  std::vector<Loop> loops_;               // by CurvePlace::loop
  std::vector<std::uint32_t> component_;  // per vertex
  std::vector<Component> components_;
  BoxGrid vertices_;       // one of each component
  double* sum_ = nullptr;  // the volume or area that the proposed merge changes; null if none
  double change_ = 0;
};

}  // namespace deliso
