// SPDX-License-Identifier: MIT
// From a cavity to a proposal. A cavity is a disk of facets that an operation wants to replace.
// Each of its functions returns a proposal: what comes in its place, and what the gates ask of it.
// A proposal is a value, complete from the beginning: Refinement::make() takes it. Several places
// may be tried in turn, each by a proposal of the same cavity.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/disk.h"
#include "surface/boundary.h"
#include "surface/surface_mesh.h"

namespace deliso {

// The edge of facet `face` opposite its corner `index`.
struct EdgeRef {
  FaceId face = kNoId;
  int index = 0;
};

// An edge of the mesh's boundary that a new vertex splits, the vertex before it in the boundary
// chain, and the new one's place on the curve.
struct BoundarySplit {
  EdgeRef edge;
  VertexId before = kNoId;
  CurvePlace place;
};

// Least cosine between the normals at an edge after a change, unless one was less before. Pieces of
// Sigma thinner than a voxel have edges nearly as sharp.
inline constexpr double kSharpestFold = -0.97;
inline constexpr double kAnyFold = -1;

// What the gates ask of a proposal beside disks, frozen facets and crossings (refine/refinement.h).
// By default all.
struct Gates {
  double least_cosine = kSharpestFold;  // G2: between the normals at an edge
  bool surface_points = true;           // G3
  bool coverage = true;                 // G4: a removed vertex is near the new facets
};
inline constexpr Gates kInsertionGates{.least_cosine = kAnyFold};
// Where a mesh touches itself: topology and crossings count, not the distance from Sigma.
constexpr Gates topology_gates(double least_cosine) {
  return {least_cosine, false, false};
}
inline constexpr Gates kTopologyGates = topology_gates(kAnyFold);

// What comes in place of a cavity. Only a cavity makes one.
class Proposal {
 public:
  Gates gates;
  enum class Vertex : std::uint8_t { none, comes, moves } what = Vertex::none;
  VertexId vertex = kNoId;             // that comes or moves
  Vec3 place;                          // of it
  std::optional<BoundarySplit> split;  // by the vertex that comes
  // The new disk. None if a vertex moves: the cavity's stay; or comes: its cone.
  std::vector<Triangle> facets;

 private:
  friend class Cavity;
  friend class Refinement;
  friend struct Replacement;
  explicit Proposal(std::uint32_t cavity = 0, const Gates& asked = {}, Vertex change = Vertex::none,
                    VertexId v = kNoId, const Vec3& p = {})
      : gates(asked), what(change), vertex(v), place(p), cavity_(cavity) {}

  std::uint32_t cavity_;  // its number
};

// Facets of the mesh that are a disk.
class Cavity {
 public:
  std::vector<FaceId> facets;
  Disk disk;                   // the same by their corners, linked
  std::vector<FaceId> across;  // per boundary edge of `disk`; kNoId on the mesh's boundary

  // The cone from a new vertex at p to the boundary of the cavity. It has no facet on the edge that
  // the vertex splits, if any.
  Proposal cone(const Vec3& p, const Gates& gates, const BoundarySplit* split = nullptr) const;
  // The same facets, with v at p.
  Proposal move(VertexId v, const Vec3& p, const Gates& gates) const;
  // The facets without corner `to`, with `from` at `to`.
  Proposal merge(VertexId from, VertexId to, const Gates& gates) const;
  // These facets.
  Proposal fill(std::span<const Triangle> list, const Gates& gates) const;

 private:
  friend class Refinement;
  std::uint32_t number_ = 0;  // of the cavities that were opened
  VertexId next_ = kNoId;     // a vertex that comes
};

// The replacement of a cavity by a proposal, as far as the gates have asked: what an operation that
// has a quantity to lower, and an observer, look at.
struct Replacement {
  Cavity cavity;
  Proposal proposal;
  std::vector<Dual> duals;      // of the new facets, in their order, as far as they are known
  std::vector<FaceId> created;  // ids of the new facets in the mesh, once they are there

  // The new disk. A vertex that moves leaves the facets as they are.
  const Disk& in() const { return moves() ? cavity.disk : in_; }
  bool has_duals() const { return duals.size() == in().facets.size(); }
  bool moves() const { return proposal.what == Proposal::Vertex::moves; }
  bool has_new_vertex() const { return proposal.what == Proposal::Vertex::comes; }

 private:
  friend class Refinement;
  void fill_cone();  // the cone of the vertex that comes
  Disk in_;
  std::vector<FaceId> across_;  // per boundary edge of in_, as Cavity::across
  // Per boundary edge of the new disk, the facet across it.
  const std::vector<FaceId>& across() const { return moves() ? cavity.across : across_; }
};

}  // namespace deliso
