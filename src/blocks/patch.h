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
  Region region;
  // In the whole mesh: the frozen facets, then those in the region, ascending each; and the
  // vertices of all, ascending.
  std::vector<FaceId> facets;
  std::vector<VertexId> vertices;
  // Its own mesh, by extract(). The chain may be open: then its ends are their own neighbors.
  SurfaceMesh mesh;
  // What of it is refined (RefineScope), and what was done.
  std::vector<std::uint8_t> is_done;
  std::vector<VertexId> thin;
  std::vector<Vec3> samples;
  Report report;
};

// Returns the vertices of the facets, ascending.
std::vector<VertexId> vertices_of(const TriMesh& mesh, std::span<const FaceId> facets);

// Sets patch.mesh.
void extract(const SurfaceMesh& whole, MeshPatch& patch);

// Copies the patch's facets in its region back, and appends new vertices and facets. Dead facets
// stay. Returns the ids of all facets of the patch in the whole mesh.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshPatch& patch);

}  // namespace deliso
