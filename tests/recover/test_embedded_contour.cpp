// SPDX-License-Identifier: MIT
// Splitting voxels of random volumes: beside them the exact contour can cross itself, and must not
// once it is embedded.
#include <doctest/doctest.h>

#include <algorithm>

#include "base/random.h"
#include "recover/embedded_contour.h"
#include "embedding/self_intersections.h"

using namespace deliso;

namespace {

constexpr int kSide = 7;

Volume random_volume(Random& random) {
  std::vector<float> samples(kSide * kSide * kSide);
  for (float& s : samples) s = static_cast<float>(random.uniform());
  return Volume::from_samples<float>({kSide, kSide, kSide}, {1, 1, 1}, samples);
}

// The whole voxels in which triangles of the contour cross, all pairs of one voxel looked at.
std::vector<std::uint64_t> crossed_voxels(const Volume& volume, const ContourMesh& contour,
                                          const ContourSplit& split) {
  std::vector<std::vector<Triangle>> in_voxel((kSide - 1) * (kSide - 1) * (kSide - 1));
  for (const Triangle& t : contour.triangles) {
    const Vec3 middle = (contour.points[t[0]] + contour.points[t[1]] + contour.points[t[2]]) / 3.0;
    in_voxel[voxel_number(volume.dims(), volume.voxel_at(middle))].push_back(t);
  }
  const auto is_listed = [&](std::uint64_t n) {
    return std::binary_search(split.voxels.begin(), split.voxels.end(), n);
  };
  const auto is_beside = [&](std::uint64_t n) {
    const Index3 voxel = numbered_voxel(volume.dims(), n);
    for (int f = 0; f < 6; ++f) {
      const Index3 other = beyond(voxel, f);
      if (other[f >> 1] < 0 || other[f >> 1] >= kSide - 1) continue;
      if (is_listed(voxel_number(volume.dims(), other))) return true;
    }
    return false;
  };
  std::vector<std::uint64_t> out;
  for (std::uint64_t n = 0; n < in_voxel.size(); ++n) {
    if (is_listed(n) || (split.elsewhere != Index3{1, 1, 1} && !is_beside(n))) continue;
    const TriangleTree tree(contour.points, in_voxel[n]);
    if (!self_intersections(contour.points, in_voxel[n], tree).empty()) out.push_back(n);
  }
  return out;
}

}  // namespace

TEST_CASE("voxels beside split ones do not cross themselves") {
  std::size_t crossed_before = 0, grown = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const Volume volume = random_volume(random);
    const double kappa = effective_isovalue(volume, 0.5);
    ContourSplit split;
    for (int n = 0; n < 20; ++n)
      split.voxels.push_back(random.below((kSide - 1) * (kSide - 1) * (kSide - 1)));
    std::sort(split.voxels.begin(), split.voxels.end());
    split.voxels.erase(std::unique(split.voxels.begin(), split.voxels.end()), split.voxels.end());
    const int cells = 2 + static_cast<int>(random.below(6));
    split.factor = {cells, cells, cells};
    if (seed % 2 == 0) split.elsewhere = {1, 2, 3};
    // The plain contour can cross itself, too: what splitting adds is meant here.
    const std::vector<std::uint64_t> plain =
        crossed_voxels(volume, build_contour(volume, kappa), split);
    const auto added = [&](const ContourMesh& contour) {
      std::vector<std::uint64_t> more;
      for (const std::uint64_t n : crossed_voxels(volume, contour, split)) {
        if (!std::binary_search(plain.begin(), plain.end(), n)) more.push_back(n);
      }
      return more.size();
    };
    const ContourMesh crude = build_contour(volume, kappa, split);
    crossed_before += added(crude);
    const std::size_t listed = split.voxels.size();
    const ContourMesh contour = build_embedded_contour(volume, kappa, split);
    grown += split.voxels.size() - listed;
    CHECK(added(contour) == 0);
    CHECK(contour.summary.components == crude.summary.components);
    CHECK(std::is_sorted(split.voxels.begin(), split.voxels.end()));
  }
  CHECK(crossed_before > 20);
  CHECK(grown >= crossed_before);
}
