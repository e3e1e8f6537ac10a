// SPDX-License-Identifier: MIT
// A volume that is read box by box, and the boxes of its samples.
#pragma once

#include <functional>
#include <optional>

#include "volume/volume.h"

namespace deliso {

// Samples `begin` to `end`, both included, along each axis; counted as positions are, from the
// first sample of the largest volume (volume/volume.h).
struct SampleBox {
  Index3 begin, end;
  Index3 dims() const { return {end.i - begin.i + 1, end.j - begin.j + 1, end.k - begin.k + 1}; }
  friend bool operator==(const SampleBox&, const SampleBox&) = default;
};
bool is_in(const SampleBox& inner, const SampleBox& outer);
SampleBox united(SampleBox a, const SampleBox& b);
// Returns the box with more samples on either side, cut off at sample 0 and `last`.
SampleBox grown(SampleBox box, Index3 by, Index3 last);

// Returns a copy of the samples in the box, as a block of the volume; of all samples the volume
// itself. The copy is contiguous, so that a block's work stays in the cache.
Volume samples_of(const Volume& volume, const SampleBox& box);

// A volume whose samples are read box by box, so that no process needs all of them. `shape` has its
// size, spacing, type and frame; its samples are read by `read` alone, in any thread.
struct VolumeSource {
  Grid shape;
  std::function<Volume(const SampleBox&)> read;  // as samples_of() returns them
  std::optional<Volume> in_memory{};             // what `read` copies from, if it does so
};
// Returns the source of a volume in memory. It may be a region of a larger one (Grid::part),
// which is the source's; then only boxes within the region can be read.
VolumeSource source_of(const Volume& volume);
// Returns the volume itself, read if it is not in memory.
Volume all_of(const VolumeSource& source);
// Returns the gradient of g (Volume::gradient). Reads the samples of one voxel.
Vec3 gradient_at(const VolumeSource& source, const Vec3& p);

}  // namespace deliso
