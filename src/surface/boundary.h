// SPDX-License-Identifier: MIT
// Where the box cuts Sigma (paper §5): the boundary curves, and the chain of mesh edges along them.
//
// A curve is a closed polygon of points of Sigma on the box, one per grid edge it crosses (the
// exact contour's boundary chain). The mesh follows it with far fewer edges: a coarse chain to
// begin with, split in the middle of an edge's arc whenever a point encroaches upon the edge, that
// is, lies in its diametral ball. Splitting goes on below voxel size: there the middle is a root on
// the bilinear arc. Both stages share this; only vertex ids change between them.
//
// Where the volume is a block of a larger one, the part of a curve in an inner face is a seam: the
// block beyond has the same, so the mesh's vertices there are those that both choose from the
// samples of the face alone (blocks/seam.h). A seam's edges are never split, its vertices never
// moved or taken out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"
#include "isosurface/isosurface.h"

namespace deliso {

// A place on a boundary curve: between points number floor(s) and floor(s) + 1 of a loop.
struct CurvePlace {
  std::uint32_t loop = kNoId;
  double s = 0;
};

struct BoundaryLoop {
  std::vector<Vec3> points;  // closed: the last is joined to the first
  // Per point: every chain needs it, since the curve turns there on an edge of the box, or it is a
  // vertex of a seam.
  std::vector<std::uint8_t> kept;
  std::vector<BoxFace> faces;  // per point: the face of the arc from it to the next
};

class BoundaryCurves {
 public:
  // Keeps a reference to the surface.
  BoundaryCurves(const Isosurface& surface, std::vector<BoundaryLoop> loops)
      : surface_(surface), loops_(std::move(loops)) {}

  std::size_t loop_count() const { return loops_.size(); }
  // Places of a coarse chain along the loop: those that are kept, and as many more points off the
  // seams as keep every chord's sagitta below `sagitta` times its length; never fewer than three.
  std::vector<CurvePlace> coarse_chain(std::uint32_t loop, double sagitta) const;
  // pre: place.s is a whole number.
  const Vec3& point(CurvePlace place) const;
  // Whether every chain needs the place.
  bool is_kept(CurvePlace place) const;
  // Whether the place, or the arc that begins there, lies on a seam.
  bool is_on_seam(CurvePlace place) const;
  bool begins_seam(CurvePlace place) const;
  // Whether a chord would run along an edge of the box beside a seam, where the block beyond might
  // have the same.
  bool runs_beside_seam(CurvePlace a, const Vec3& pa, CurvePlace b, const Vec3& pb) const;

  struct Split {
    CurvePlace place;
    Vec3 point;
  };
  // A point near the middle of the arc that runs from a (at pa) to b (at pb): a point of the curve,
  // or the middle of the piece between two of them, whichever is nearer to half of its length, so
  // that neither half is much shorter. Nothing when the arc is too short to have one
  // that differs from its ends.
  std::optional<Split> split(CurvePlace a, const Vec3& pa, CurvePlace b, const Vec3& pb) const;
  // How far that arc runs from its chord.
  double sagitta(CurvePlace a, const Vec3& pa, CurvePlace b, const Vec3& pb) const;

 private:
  // The points of an arc: its ends, and those of the curve between them.
  struct ArcPoint {
    double s;  // not reduced: beyond the loop's length where the arc passes its first point
    Vec3 p;
  };
  std::vector<ArcPoint> arc(CurvePlace a, const Vec3& pa, CurvePlace b, const Vec3& pb) const;
  // The middle of the piece of a curve between two points of one arc, next to each other.
  std::optional<Vec3> middle(std::uint32_t loop, const ArcPoint& from, const ArcPoint& to) const;

  const Isosurface& surface_;
  std::vector<BoundaryLoop> loops_;
};

// The chain: which vertices lie on a curve, where, and who comes next.
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
  // Puts v between a and its next.
  void insert_after(VertexId a, VertexId v, CurvePlace place);
  // Joins v's neighbours to each other. pre: the loop has more than three vertices.
  void remove(VertexId v);
  // The same chain over vertices renumbered by new_id (kNoId: the vertex is gone, as happens where
  // the paper's tests lose facets; its neighbours are joined).
  BoundaryChain renumbered(std::span<const VertexId> new_id) const;
  std::size_t vertex_capacity() const { return links_.size(); }

 private:
  struct Link {
    VertexId next = kNoId, previous = kNoId;
    CurvePlace place;
  };
  Link& link(VertexId v);
  std::vector<Link> links_;
};

// A boundary edge shorter than this share of r_min is not split, in either stage: where the curve
// turns sharply at an edge of the box, its two sides would encroach upon each other for ever.
inline constexpr double kShortestBoundaryEdge = 0.25;

// From p to the segment ab, squared.
double distance2_to_chord(const Vec3& p, const Vec3& a, const Vec3& b);

// p lies strictly inside the ball whose diameter is ab.
constexpr bool in_diametral_ball(const Vec3& a, const Vec3& b, const Vec3& p) {
  return dot(a - p, b - p) < 0;
}

}  // namespace deliso
