// SPDX-License-Identifier: MIT
// The walk over the samples in slabs, one for each thread and more, and what they find made one.
// Slabs meet in a layer of samples: both know the crossings in it, in the same order, so welding
// needs no search. Vertices, triangles and components then have the numbers that one walk over all
// layers gives them (I6 of contour/contour.h), wherever the volume is cut.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contour/contour_stream.h"

namespace deliso {

// Slabs of the volume's layers for that many threads, in order; thinner ones than these are not
// worth it. A slab may begin at layer k where can_begin(k), and at 0.
inline constexpr int kFewestLayers = 8, kFewestSamples = 1 << 16;
template <class CanBegin>
std::vector<Slab> cut_into_slabs(Index3 dims, int threads, CanBegin&& can_begin) {
  constexpr int kPerThread = 4;
  const auto enough = static_cast<int>(std::min<std::int64_t>(
      dims.k / kFewestLayers, std::int64_t{dims.i} * dims.j * dims.k / kFewestSamples));
  const int count = threads > 1 ? std::max(1, std::min(kPerThread * threads, enough)) : 1;
  std::vector<Slab> slabs{{0, dims.k}};
  for (int n = 1; n < count; ++n) {
    const int k = static_cast<int>(std::int64_t{dims.k} * n / count);
    if (!can_begin(k)) continue;
    slabs.back().end = k;
    slabs.push_back({k, dims.k});
  }
  return slabs;
}

// The numbers that the vertices and labels of a slab get.
struct SlabNumbers {
  std::vector<VertexId> shared;  // of its first vertices, which are the slab before's
  VertexId first = 0;            // of the first vertex of its own
  VertexId end = 0;              // behind the last one
  std::uint32_t raised = 0;      // by how much labels are raised

  VertexId of(VertexId v) const {
    return v < shared.size() ? shared[v] : VertexId(first + (v - shared.size()));
  }
};

// Makes one walk, the first, of walks over slabs in order. vertices[n]: how many ids walk n has
// given, those it shares first. Throws InputError where there are too many.
std::vector<SlabNumbers> weld(std::vector<SlabWalk>& walks,
                              const std::vector<std::size_t>& vertices);

// The same for the meshes, all but what the walk knows: components stay labels.
ContourMesh weld(std::vector<ContourMesh> parts, const std::vector<SlabNumbers>& numbers,
                 int threads);

}  // namespace deliso
