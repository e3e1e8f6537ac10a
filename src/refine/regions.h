// SPDX-License-Identifier: MIT
// The mesh cut into regions that are refined by themselves, side by side, and put together again.
//
// Planes cut space into boxes that share no point. A region has the facets that lie in one box and
// touch no boundary edge. Only they are replaced, by facets in the same box. So facets of two
// regions never meet, and the gates of refine/refinement.h hold. Other facets that reach into the
// box are visible to the gates, and frozen. After the regions are merged, facets near the cuts are
// refined like any other.
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
  std::vector<std::uint32_t> samples;  // the numbers of those that concern this region alone
  // By extract(): a mesh of these facets, without chain, and its vertices' ids in the whole mesh.
  std::vector<VertexId> vertices;
  SurfaceMesh surface;
};

// Regions of about `most` facets or fewer; none where the mesh is too small to be cut. Of the
// numbers in `samples` they take those of samples that lie further than `reach` from all cuts.
// pre: no facet is dead.
std::vector<MeshRegion> cut_into_regions(const SurfaceMesh& whole, std::size_t most,
                                         std::span<const Vec3> points, double reach,
                                         std::vector<std::uint32_t>& samples);

void extract(const SurfaceMesh& whole, MeshRegion& region);

// Puts a region back where it was taken from; what it has more is appended. Dead facets stay.
// Returns the numbers in the whole mesh of the region's facets. Neighbors are the caller's to link,
// once all regions are back.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshRegion& region);

}  // namespace deliso
