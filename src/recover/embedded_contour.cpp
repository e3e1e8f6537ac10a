// SPDX-License-Identifier: MIT
#include "recover/embedded_contour.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/sorted_list.h"
#include "embedding/self_intersections.h"

namespace deliso {
namespace {

// The voxels that share a face with a listed one and are not listed themselves.
std::vector<std::uint64_t> beside(const Volume& volume, const std::vector<std::uint64_t>& voxels) {
  const Index3 count = volume.voxels();
  std::vector<std::uint64_t> all, out;
  for (const std::uint64_t n : voxels) {
    for (int f = 0; f < 6; ++f) {
      const Index3 next = beyond(numbered_voxel(volume.dims(), n), f);
      if (next[f >> 1] < 0 || next[f >> 1] >= count[f >> 1]) continue;
      all.push_back(voxel_number(volume.dims(), next));
    }
  }
  sort_out(all);
  std::set_difference(all.begin(), all.end(), voxels.begin(), voxels.end(),
                      std::back_inserter(out));
  return out;
}

// Of the listed voxels, those in which triangles of the contour cross.
std::vector<std::uint64_t> crossed(const Volume& volume, const ContourMesh& contour,
                                   const std::vector<std::uint64_t>& voxels) {
  std::vector<Triangle> triangles;
  std::vector<std::uint64_t> voxel_of;
  for (const Triangle& t : contour.triangles) {
    // A triangle lies in one voxel, and its middle in no other.
    const Vec3 middle = (contour.points[t[0]] + contour.points[t[1]] + contour.points[t[2]]) / 3.0;
    const std::uint64_t n = voxel_number(volume.dims(), volume.voxel_at(middle));
    if (!std::binary_search(voxels.begin(), voxels.end(), n)) continue;
    triangles.push_back(t);
    voxel_of.push_back(n);
  }
  const TriangleTree tree(contour.points, triangles);
  std::vector<std::uint64_t> out;
  for (const auto& [f, g] : self_intersections(contour.points, triangles, tree)) {
    out.push_back(voxel_of[f]);
    out.push_back(voxel_of[g]);
  }
  sort_out(out);
  return out;
}

}  // namespace

ContourMesh build_embedded_contour(const Volume& volume, double kappa, ContourSplit& split) {
  for (;;) {
    ContourMesh contour = build_contour(volume, kappa, split);
    const std::vector<std::uint64_t> more = crossed(volume, contour, beside(volume, split.voxels));
    if (more.empty()) return contour;
    split.voxels = united(split.voxels, more);
  }
}

}  // namespace deliso
