// SPDX-License-Identifier: MIT
// Where the box cuts Sigma (paper §5): the boundary curves, and the chain of mesh edges along them.
//
// A curve is a closed polygon of points of Sigma on the box, one per grid edge it crosses: a
// boundary loop of the exact contour. The mesh has all of these points at first, and Stage 1
// removes most. In Stage 2 an edge is split in the middle of its arc when a point encroaches upon
// it, that is, lies in its diametral ball. Below voxel size the middle is a root on the bilinear
// arc.
//
// Some arcs are fixed: edges along them are never split, their ends never moved or removed. The
// seams of a block are such arcs, until it is welded (blocks/weld.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "contour/boundary_loop.h"
#include "isosurface/isosurface.h"

namespace deliso {

// A place on a boundary curve, between points floor(s) and floor(s) + 1 of a loop.
struct CurvePlace {
  std::uint32_t loop = kNoId;
  double s = 0;
};

struct CurvePoint {
  CurvePlace place;
  Vec3 point;
};

// True if the arc of the loop that begins at place s is fixed, or that before it ends there and is.
bool is_on_fixed(const BoundaryLoop& loop, double s);

class BoundaryCurves {
 public:
  // Keeps a reference to the surface.
  BoundaryCurves(const Isosurface& surface, std::shared_ptr<const BoundaryLoops> loops)
      : surface_(surface), loops_(std::move(loops)) {}

  const BoundaryLoop& loop(std::uint32_t number) const { return (*loops_)[number]; }
  // Returns the point of the curve at a place. pre: place.s is a whole number.
  const Vec3& point(CurvePlace place) const;
  // True if every chain must have a vertex at the place.
  bool is_kept(CurvePlace place) const;
  // True if the arc that begins at the place is fixed; if it is, or that before it.
  bool begins_fixed(CurvePlace place) const {
    return loop(place.loop)[static_cast<std::size_t>(place.s)].is_fixed;
  }
  bool is_on_fixed(CurvePlace place) const {
    return deliso::is_on_fixed(loop(place.loop), place.s);
  }
  // True if the chord ab runs along an edge of the box beside a fixed arc: the neighboring block
  // might have the same chord.
  bool runs_beside_fixed(const CurvePoint& a, const CurvePoint& b) const;

  // Returns a point near the middle of the arc from a to b, by length: a point of the curve, or
  // the middle between two. Nullopt if the arc is too short for a point other than its ends.
  std::optional<CurvePoint> split(const CurvePoint& a, const CurvePoint& b) const;
  // True if a point of the curve between a and b is further from their chord than `limit`.
  bool strays(const CurvePoint& a, const CurvePoint& b, double limit) const;
  // Returns the largest distance from the arc to its chord.
  double sagitta(const CurvePoint& a, const CurvePoint& b) const;

 private:
  // Returns the ends of an arc and the points of the curve between them. Places are not reduced:
  // after the loop's first point they exceed its length.
  std::vector<CurvePoint> arc(const CurvePoint& a, const CurvePoint& b) const;
  // Returns the middle of the curve between two consecutive points of an arc.
  std::optional<Vec3> middle(const CurvePoint& from, const CurvePoint& to) const;

  const Isosurface& surface_;
  std::shared_ptr<const BoundaryLoops> loops_;
};

// The vertices on the boundary curves: their places, and the next and previous vertex of each.
class BoundaryChain {
 public:
  bool is_boundary(VertexId v) const { return v < links_.size() && links_[v].next != kNoId; }
  VertexId next(VertexId v) const { return links_[v].next; }
  VertexId previous(VertexId v) const { return links_[v].previous; }
  CurvePlace place(VertexId v) const { return links_[v].place; }
  bool is_edge(VertexId a, VertexId b) const {
    return is_boundary(a) && (links_[a].next == b || links_[a].previous == b);
  }

  void add_loop(std::span<const VertexId> vertices, std::span<const CurvePlace> places);
  // Sets the place and the neighbors of v, of a chain that need not be closed.
  void set(VertexId v, VertexId previous, VertexId next, CurvePlace place) {
    link(v) = {next, previous, place};
  }
  // Inserts v between a and the next vertex.
  void insert_after(VertexId a, VertexId v, CurvePlace place);
  // Joins v's neighbors to each other. pre: the loop has more than three vertices.
  void remove(VertexId v);
  // Returns the chain with every vertex v renumbered as new_id[v]. Where that is kNoId, v is
  // removed and its neighbors are joined.
  BoundaryChain renumbered(const std::vector<VertexId>& new_id) const;
  std::size_t vertex_capacity() const { return links_.size(); }

 private:
  struct Link {
    VertexId next = kNoId, previous = kNoId;
    CurvePlace place;
  };
  Link& link(VertexId v) {
    if (v >= links_.size()) links_.resize(v + 1);
    return links_[v];
  }
  std::vector<Link> links_;
};

// True if p lies strictly inside the ball with diameter ab.
constexpr bool in_diametral_ball(const Vec3& a, const Vec3& b, const Vec3& p) {
  return dot(a - p, b - p) < 0;
}

}  // namespace deliso
