// SPDX-License-Identifier: MIT
// The topology of Sigma by signs alone: an oracle without saddles, hyperbolas or tubes. Every voxel
// is cut into n x n x n cells, and the signs of g - kappa are taken at their corners. In a cell
// each loop of segments on its faces bounds a disk. Components, V - E + F
// and boundary loops of all disks are counted. With n = 1 this is Marching Cubes on the samples.
//
// The counts tend to those of Sigma as n grows, if kappa is a regular value: in the end every
// feature of Sigma is larger than a cell. Nothing says which n suffices. The two rules for faces
// with alternating corners are wrong to either side: one separates what should be joined, the other
// joins what should be separate. Where both give the same, no such face matters any more.
//
//   O1  Nothing of contour/ or check/ is used, nor their rules. Only the samples, kappa and "inside
//       is g >= kappa" are common to both.
//   O2  A voxel whose corners have one sign is left out: g lies between its samples there.
//   O3  Cells on both sides of a face see the same signs, to the last bit, and follow one rule.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/topology_counts.h"
#include "volume/volume.h"

namespace deliso {

// The cells of a voxel along each axis, at most.
inline constexpr int kMaxOversampling = 63;

struct OversampledComponent {
  std::int64_t euler = 0;
  std::uint64_t boundary_loops = 0;
  friend auto operator<=>(const OversampledComponent&, const OversampledComponent&) = default;
};

using OversampledComponents = std::vector<OversampledComponent>;  // sorted

// By the rule for faces with alternating corners: segments keep the inside corners apart, or join
// them.
struct OversampledTopology {
  OversampledComponents inside_apart, inside_joined;
  bool rules_agree() const { return inside_apart == inside_joined; }
};

// Returns the components with n cells per voxel and axis, 1 <= n <= kMaxOversampling. Voxels are
// sampled one after the other. Cost: O(n^3) for each voxel that Sigma meets. Memory: 12 n^3 bytes,
// the crossings on the faces of a layer of voxels, and a few words for each piece in a voxel.
// pre: no sample is NaN or infinite, and none is so large that n^3 times it overflows.
OversampledTopology oversampled_topology(const Volume& volume, double kappa, int n);

TopologyCounts counts_of(const OversampledComponents& components);

}  // namespace deliso
