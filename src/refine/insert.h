// SPDX-License-Identifier: MIT
// Insertion in the plain mesh (paper §2.2.2, Figure 3): the facets whose surface balls hold the new
// point p, found by walking from one of them, are the disk E; the cone from p over its rim, D,
// takes its place. A point that comes near an edge of the boundary splits that edge instead (paper
// §5).
//
// Differs from the paper in that E must be a disk with all its vertices on the rim, and that D must
// pass the gates of refine/replace_disk.h: what does not is refused, and the mesh stays as it is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "refine/replace_disk.h"
#include "surface/boundary.h"

namespace deliso {

// The edge of facet `face` opposite its corner `index`.
struct EdgeRef {
  FaceId face = kNoId;
  int index = 0;
};

class Inserter {
 public:
  // Keeps references.
  Inserter(SurfaceMesh& surface_mesh, DiskReplacer& replacer, const BoundaryCurves& curves,
           const Parameters& parameters, Report& report);

  // Inserts p, a point of Sigma, or the middle of the boundary edge that it encroaches upon;
  // whether either was done. E begins with `start`. Counts under `rung`.
  bool insert(Rung rung, FaceId start, const Vec3& p);
  // Why the last insert() did nothing.
  std::optional<Refusal> refusal() const { return refusal_; }

  // Inserts the middle of the arc that a boundary edge stands for. pre: no facet beyond it.
  bool split_boundary(EdgeRef edge);
  // Whether the arc runs further from the edge than facets may from Sigma.
  bool leaves_curve(EdgeRef edge) const;

  // The facets that the last insertion made.
  std::span<const FaceId> created() const { return change_.created; }

 private:
  // `opened`: the boundary edge that p splits, on which D has no facet.
  std::optional<Refusal> try_insert(FaceId start, const Vec3& p, std::optional<EdgeRef> opened);
  void find_encroached(FaceId start, const Vec3& p);
  std::optional<EdgeRef> encroached_boundary(const Vec3& p) const;
  // The boundary edge's ends as the chain runs; nothing when it is none of the chain.
  struct ChainEdge {
    VertexId from, to;
  };
  std::optional<ChainEdge> on_chain(EdgeRef edge) const;

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  DiskReplacer& replacer_;
  const BoundaryCurves& curves_;
  const Parameters& parameters_;
  Report& report_;
  Change change_;  // `out` is E, `in` is D
  std::optional<Refusal> refusal_;
  std::vector<std::uint32_t> marks_;  // per facet: stamp_ when it is in E
  std::uint32_t stamp_ = 0;
};

}  // namespace deliso
