// SPDX-License-Identifier: MIT
// Cuts the mesh into regions that threads refine independently, and merges them again.
//
// Planes cut space into boxes that share no point. A region has the facets that lie in one box and
// touch no boundary edge. Only they are replaced, by facets in the same box. So facets of two
// regions never meet, and the gates of refine/refinement.h hold. Other facets that reach into the
// box are visible to the gates, and frozen. After the merge, facets near the cuts are refined like
// any other.
//
// The cuts follow from the mesh alone, so the result is the same with any number of threads. A
// region is small: its mesh, its hashes and its samples of the volume stay in a cache.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/refinement.h"

namespace deliso {

struct MeshRegion {
  Region box;
  // In the whole mesh: the frozen facets, then the region's own, ascending each.
  std::vector<FaceId> facets;
  std::vector<std::uint32_t> samples;  // numbers of the samples that only this region can be near
  // Set by extract(): the ids of its vertices in the whole mesh, and a mesh of these facets,
  // without chain.
  std::vector<VertexId> vertices;
  SurfaceMesh surface;
};

// Returns regions with at most `most` free facets; none if the mesh is too small to be cut. Moves
// the numbers of samples further than `margin` from all cuts from `samples` to their regions. pre:
// no facet is dead.
std::vector<MeshRegion> cut_into_regions(const SurfaceMesh& whole, std::size_t most,
                                         std::span<const Vec3> points, double margin,
                                         std::vector<std::uint32_t>& samples);

// Sets region.vertices and region.surface.
void extract(const SurfaceMesh& whole, MeshRegion& region);

// Copies a region back into the whole mesh and appends its new vertices and facets. Dead facets
// stay. Returns the ids of the region's facets in the whole mesh. The caller links neighbors after
// the last region.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshRegion& region);

}  // namespace deliso
