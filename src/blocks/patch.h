// SPDX-License-Identifier: MIT
// A part of a mesh, as a mesh of its own that can be refined and put back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/refinement.h"
#include "surface/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

struct MeshPatch {
  FreeBox free_box;
  // In the whole mesh: the frozen facets, then those in the free box; the vertices outside the
  // free box, then those in it. Each in the order of their places, so that what is done to the
  // patch does not depend on the whole's ids.
  std::vector<FaceId> facets;
  std::vector<VertexId> vertices;
  // Its own mesh, by extract(). The chain may be open: then its ends are their own neighbors.
  SurfaceMesh mesh;
  // What of it is coarsened (CoarsenScope) and refined (RefineScope), and what was done.
  std::vector<VertexId> first;
  std::vector<std::uint8_t> is_done;
  std::vector<Vec3> samples;
  Report report;
};

// The numbers of facets and vertices in the one patch whose free box holds them.
struct PlacesInPatches {
  IdArray<FaceId, FaceId> facet;
  IdArray<VertexId, VertexId> vertex;
};

// Puts patch.facets in order, and sets the free box's first_free, patch.vertices and patch.mesh;
// facets begin with their first vertex in that order. Writes only the places of what the patch's
// free box holds, so several patches may be extracted at once.
void extract(const SurfaceMesh& whole, MeshPatch& patch, PlacesInPatches& places);

// Copies the patch's facets in its free box back. New vertices and facets get the ids of removed
// ones; when those are used up, they are appended. Dead facets stay. Returns the ids of the patch's
// facets in the whole mesh; kNoId for new ones that died.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch);

}  // namespace deliso
