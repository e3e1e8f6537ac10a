// SPDX-License-Identifier: MIT
// Walks over the samples in slabs, up to four for each thread, and the welding of their results.
// Slabs meet in a layer of samples. Both have the crossings in it, in the same order, so welding
// needs no search. Vertices, triangles and components then have the numbers of one walk over all
// layers (I6 of contour/contour.h), wherever the volume is cut.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contour/contour_stream.h"

namespace deliso {

// Cuts the volume's layers into slabs for that many threads, in order. A slab may begin at layer k
// if can_begin(k), and at 0. Thinner slabs than these do not pay.
inline constexpr int kMinSlabLayers = 8, kMinSlabSamples = 1 << 16;
template <class CanBegin>
std::vector<Slab> cut_into_slabs(Index3 dims, int threads, CanBegin&& can_begin) {
  constexpr int kSlabsPerThread = 4;
  const auto enough = static_cast<int>(std::min<std::int64_t>(
      dims.k / kMinSlabLayers, std::int64_t{dims.i} * dims.j * dims.k / kMinSlabSamples));
  const int count = threads > 1 ? std::max(1, std::min(kSlabsPerThread * threads, enough)) : 1;
  std::vector<Slab> slabs{{0, dims.k}};
  for (int n = 1; n < count; ++n) {
    const int k = static_cast<int>(std::int64_t{dims.k} * n / count);
    if (!can_begin(k)) continue;
    slabs.back().end = k;
    slabs.push_back({k, dims.k});
  }
  return slabs;
}

// The final numbers of the vertices and labels of a slab.
struct SlabNumbers {
  std::vector<VertexId> shared;  // of its first vertices, shared with the slab before
  VertexId first = 0;            // of the first vertex of its own
  VertexId end = 0;              // one past the last one
  std::uint32_t offset = 0;      // added to labels

  VertexId of(VertexId v) const {
    return v < shared.size() ? shared[v] : VertexId(first + (v - shared.size()));
  }
};

// Merges walks over slabs in order into the first walk. vertices[n]: how many ids walk n has given,
// shared ones first. Throws InputError if there are 2^32 vertices or more.
std::vector<SlabNumbers> weld(std::vector<SlabWalk>& walks,
                              const std::vector<std::size_t>& vertices);

// Merges the meshes of slabs in order. Components stay labels.
ContourMesh weld(std::vector<ContourMesh> parts, const std::vector<SlabNumbers>& numbers,
                 int threads);

}  // namespace deliso
