// SPDX-License-Identifier: MIT
// Where the box cuts Sigma (paper §5): the boundary curves, and the chain of mesh edges along them.
//
// A curve is a closed polygon of points of Sigma on the box, one per grid edge it crosses (the
// exact contour's boundary chain). The mesh follows it with far fewer edges: a coarse chain to
// begin with, split in the middle of an edge's arc whenever a point encroaches upon the edge, that
// is, lies in its diametral ball. Splitting goes on below voxel size: there the middle is a root on
// the bilinear arc. Both stages share this; only vertex ids change between them.
//
// Where the volume is a block of a larger one, the part of a curve in an inner face is a seam. The
// block beyond has the same seam: both choose its vertices from the samples of the face alone
// (blocks/seam.h). Edges of a seam are never split, its vertices never moved or removed.
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

struct CurvePoint {
  CurvePlace place;
  Vec3 point;
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
  bool runs_beside_seam(const CurvePoint& a, const CurvePoint& b) const;

  // A point near the middle of the arc from a to b. It is a point of the curve, or the middle of
  // the piece between two of them, whichever is nearer to half of the arc's length. Nothing when
  // the arc is too short for a point that differs from its ends.
  std::optional<CurvePoint> split(const CurvePoint& a, const CurvePoint& b) const;
  // How far that arc runs from its chord.
  double sagitta(const CurvePoint& a, const CurvePoint& b) const;

 private:
  // The points of an arc: its ends, and those of the curve between them. Places are not reduced:
  // they are beyond the loop's length where the arc passes its first point.
  std::vector<CurvePoint> arc(const CurvePoint& a, const CurvePoint& b) const;
  // The middle of the piece of a curve between two points of one arc, next to each other.
  std::optional<Vec3> middle(const CurvePoint& from, const CurvePoint& to) const;

  const Isosurface& surface_;
  std::vector<BoundaryLoop> loops_;
};

// The chain: which vertices lie on a curve, where, and who comes next. In Stage 1 they are sites,
// then vertices of the mesh.
template <class Vertex>
class Chain {
 public:
  bool is_boundary(Vertex v) const { return v < links_.size() && links_[v].next != kNoId; }
  Vertex next(Vertex v) const { return links_[v].next; }
  Vertex previous(Vertex v) const { return links_[v].previous; }
  CurvePlace place(Vertex v) const { return links_[v].place; }
  bool is_edge(Vertex a, Vertex b) const {
    return is_boundary(a) && (links_[a].next == b || links_[a].previous == b);
  }

  void add_loop(std::span<const Vertex> vertices, std::span<const CurvePlace> places);
  // Puts v between a and its next.
  void insert_after(Vertex a, Vertex v, CurvePlace place);
  // Joins v's neighbors to each other. pre: the loop has more than three vertices.
  void remove(Vertex v);
  // The same chain over vertices renumbered by new_id (kNoId: the vertex is gone, as happens where
  // the paper's tests lose facets; its neighbors are joined).
  template <class Other>
  Chain<Other> renumbered(const std::vector<Other>& new_id) const;
  std::size_t vertex_capacity() const { return links_.size(); }

 private:
  template <class Other>
  friend class Chain;
  struct Link {
    Vertex next = kNoId, previous = kNoId;
    CurvePlace place;
  };
  Link& link(Vertex v) {
    if (v >= links_.size()) links_.resize(v + 1);
    return links_[v];
  }
  std::vector<Link> links_;
};
using BoundaryChain = Chain<VertexId>;
using SiteChain = Chain<SiteId>;

// A boundary edge shorter than this share of r_min is not split, in either stage: where the curve
// turns sharply at an edge of the box, its two sides would encroach upon each other for ever.
inline constexpr double kShortestBoundaryEdge = 0.25;

// From p to the segment ab, squared.
double distance2_to_chord(const Vec3& p, const Vec3& a, const Vec3& b);

// p lies strictly inside the ball whose diameter is ab.
constexpr bool in_diametral_ball(const Vec3& a, const Vec3& b, const Vec3& p) {
  return dot(a - p, b - p) < 0;
}

template <class Vertex>
void Chain<Vertex>::add_loop(std::span<const Vertex> vertices, std::span<const CurvePlace> places) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    link(vertices[i]) = {vertices[(i + 1) % n], vertices[(i + n - 1) % n], places[i]};
  }
}

template <class Vertex>
void Chain<Vertex>::insert_after(Vertex a, Vertex v, CurvePlace place) {
  const Vertex b = links_[a].next;
  link(v) = {b, a, place};
  links_[a].next = v;
  links_[b].previous = v;
}

template <class Vertex>
void Chain<Vertex>::remove(Vertex v) {
  const Link gone = links_[v];
  links_[gone.previous].next = gone.next;
  links_[gone.next].previous = gone.previous;
  links_[v] = {};
}

template <class Vertex>
template <class Other>
Chain<Other> Chain<Vertex>::renumbered(const std::vector<Other>& new_id) const {
  Chain<Other> chain;
  for (Vertex v{0}; v < links_.size(); ++v) {
    if (!is_boundary(v) || new_id[v] == kNoId) continue;
    Vertex after = links_[v].next, before = links_[v].previous;  // ends at v at the latest
    while (new_id[after] == kNoId) after = links_[after].next;
    while (new_id[before] == kNoId) before = links_[before].previous;
    chain.link(new_id[v]) = {new_id[after], new_id[before], links_[v].place};
  }
  return chain;
}

}  // namespace deliso
