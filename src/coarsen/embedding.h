// SPDX-License-Identifier: MIT
// Tests once, in the end, what no change of the coarsener asks: that the mesh is embedded as it was
// before.
//   F1  No two facets cross, by exact predicates, and none is without an area.
//   F2  No component is reversed: the volume that it bounds keeps its sign.
//   F3  No component was passed by another. Lines from a facet of each component meet the next
//       facet from the side from which they come, outside or inside.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/box3.h"
#include "surface/free_box.h"
#include "surface/surface_mesh.h"

namespace deliso {

// The connected components of a mesh.
struct MeshComponents {
  // Facets before `first_free` are frozen. pre: none is dead.
  MeshComponents(const TriMesh& mesh, const BoundaryChain& chain, FaceId first_free,
                 const Box3& box);

  std::size_t count() const { return origin.size(); }
  // Asks no more for F2 and F3 of these: by rounding they were at fault before a change. Sheets
  // that nearly touch seem to be in another order then.
  void leave_out(std::span<const std::uint32_t> components) {
    for (const std::uint32_t c : components) is_left_out[c] = 1;
  }

  // Returns six times the volumes between the components' facets and their origins; 0 without one.
  std::vector<double> volumes(const TriMesh& mesh) const;

  IdArray<VertexId, std::uint32_t> of;  // per vertex
  std::vector<std::uint32_t> size;      // per component: vertices
  std::vector<std::uint8_t> is_frozen;  // per component: a facet is frozen
  std::vector<std::uint8_t> is_left_out;
  // Per component a point in all faces of the box that it meets: seen from there its open ends
  // bound no volume. Nothing for those that meet opposite faces, are frozen or have no facets.
  std::vector<std::optional<Vec3>> origin;
  std::vector<double> bounded;  // volumes() of the mesh
};

struct EmbeddingFaults {
  std::vector<FaceId> facets;             // of F1 and F3
  std::vector<std::uint32_t> components;  // of F2 and F3

  bool none() const { return facets.empty() && components.empty(); }
};

// Returns the faults of a mesh of which some facets changed. `components`: before that; vertices
// keep their numbers. `box`: of the volume; within the free box no facet is missing.
EmbeddingFaults embedding_faults(const SurfaceMesh& s, const MeshComponents& components,
                                 std::span<const std::uint8_t> changed, const FreeBox& free_box,
                                 const Box3& box);

}  // namespace deliso
