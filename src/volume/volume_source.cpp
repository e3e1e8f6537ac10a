// SPDX-License-Identifier: MIT
#include "volume/volume_source.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "base/check.h"

namespace deliso {

SampleBox grown(SampleBox box, Index3 by, Index3 last) {
  for (int axis = 0; axis < 3; ++axis) {
    box.begin[axis] = std::max(box.begin[axis] - by[axis], 0);
    box.end[axis] = std::min(box.end[axis] + by[axis], last[axis]);
  }
  return box;
}

bool is_in(const SampleBox& inner, const SampleBox& outer) {
  for (int axis = 0; axis < 3; ++axis) {
    if (inner.begin[axis] < outer.begin[axis] || inner.end[axis] > outer.end[axis]) return false;
  }
  return true;
}

SampleBox united(SampleBox a, const SampleBox& b) {
  for (int axis = 0; axis < 3; ++axis) {
    a.begin[axis] = std::min(a.begin[axis], b.begin[axis]);
    a.end[axis] = std::max(a.end[axis], b.end[axis]);
  }
  return a;
}

Volume samples_of(const Volume& volume, const SampleBox& box) {
  const Index3 dims = box.dims(), first = volume.first();
  DELISO_CHECK(is_in(box, {first, first + volume.voxels()}));
  if (dims == volume.dims()) return volume;
  const std::size_t size = size_of(volume.type());
  const std::size_t row = size * dims.i;
  const auto bytes = std::make_shared<std::vector<std::byte>>(row * dims.j * dims.k);
  std::byte* to = bytes->data();
  const std::byte* const from =
      volume.visit([](const auto* samples) { return reinterpret_cast<const std::byte*>(samples); });
  for (int k = box.begin.k - first.k; k <= box.end.k - first.k; ++k) {
    for (int j = box.begin.j - first.j; j <= box.end.j - first.j; ++j, to += row) {
      std::memcpy(to, from + size * volume.index(box.begin.i - first.i, j, k), row);
    }
  }
  return {volume.part(box.begin, dims), bytes->data(), bytes};
}

VolumeSource source_of(const Volume& volume) {
  return {volume.whole(), [volume](const SampleBox& box) { return samples_of(volume, box); },
          volume};
}

Volume all_of(const VolumeSource& source) {
  return source.in_memory ? *source.in_memory : source.read({{}, source.shape.voxels()});
}

Vec3 gradient_at(const VolumeSource& source, const Vec3& p) {
  const Index3 voxel = source.shape.voxel_at(p);
  return source.read({voxel, corner_of(voxel, 7)}).gradient(p);
}

}  // namespace deliso
