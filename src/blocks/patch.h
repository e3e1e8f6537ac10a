// SPDX-License-Identifier: MIT
// A part of a mesh, as a mesh of its own that can be refined and put back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/refinement.h"
#include "run/report.h"
#include "surface/surface_mesh.h"

namespace deliso {

struct MeshPatch {
  std::uint32_t place = 0;  // of its free box
  FreeBox free_box;
  // In the whole mesh: the frozen facets, then those in the free box; the vertices outside the
  // free box, then those in it. Each in the order of their places, so that what is done to the
  // patch does not depend on the whole's ids.
  std::vector<FaceId> facets;
  std::vector<VertexId> vertices;
  VertexId first_held = 0;  // in `vertices`: the first in the free box
  // Its own mesh, by extract(). The chain may be open: then its ends are their own neighbors.
  SurfaceMesh mesh;
  // What of it is coarsened (CoarsenScope) and refined (RefineScope), and what was done.
  std::vector<VertexId> first;
  std::vector<std::uint8_t> is_done;
  std::vector<Vec3> samples;
  Report report;
};

// Of a whole mesh that is divided into places, some of which are the free boxes of patches.
template <class Id>
struct Places {
  IdArray<Id, std::uint32_t> of;  // the place of each element; kNoId: a facet lies in several
  // Its number in the patch whose free box holds it, if it is in one. At first kNoId.
  IdArray<Id, Id> number;
};
struct PlacesInPatches {
  Places<VertexId> vertices;
  Places<FaceId> facets;
};

// Puts patch.facets in order, and sets the free box's first_free, patch.vertices and patch.mesh;
// facets begin with their first vertex in that order. Writes only the numbers of what the patch's
// free box holds, so several patches may be extracted at once. pre: patch.facets has all facets in
// the free box.
void extract(const SurfaceMesh& whole, MeshPatch& patch, PlacesInPatches& places);

// Copies the patch's facets in its free box back. New vertices and facets get the ids of removed
// ones; when those are used up, they are appended. Dead facets stay. Returns the ids of the patch's
// facets in the whole mesh; kNoId for new ones that died.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch);

}  // namespace deliso
