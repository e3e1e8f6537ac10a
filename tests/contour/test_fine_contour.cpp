// SPDX-License-Identifier: MIT
// T for Stage 1, on random volumes. No two of its triangles cross, by all pairs of each voxel and
// of all voxels, and it has the topology of the plain contour.
#include "contour/fine_contour.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/random.h"
#include "check/self_intersections.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/mesh_checks.h"
#include "contour/split_voxels.h"

using namespace deliso;

namespace {

struct Noise {
  Volume volume;
  double kappa;
};

// Pure noise; every third volume has only a few values, every fifth long voxels, every
// seventh uneven steps.
Noise random_noise(std::uint64_t seed) {
  Random random(seed);
  const auto side = [&] { return 3 + static_cast<int>(random.below(5)); };
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) dims[axis] = side();
  const std::uint32_t levels = seed % 3 == 0 ? 2 + random.below(6) : 1000;
  std::vector<float> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
    samples.push_back(
        static_cast<float>(levels == 1000 ? random.uniform(0, 1000) : random.below(levels)));
  }
  Vec3 spacing{1, 1, 1};
  if (seed % 5 == 0) spacing[static_cast<int>(random.below(3))] = random.uniform(1, 8);
  Volume volume = Volume::from_samples(dims, spacing, samples);
  if (seed % 7 == 0) {
    Coordinates places;
    for (int k = 0; k < dims.k; ++k) places[2].push_back(k + 0.05 * k * k);
    volume = volume.with_places(places, "noise");
  }
  const double kappa = geometric_isovalue(volume.type(), 0.5 * levels - 0.5 * random.below(2));
  return {std::move(volume), kappa};
}

std::size_t crossings(const ContourMesh& contour) {
  const std::vector<Triangle> triangles = contour_as_mesh(contour).mesh.triangles();
  const TriangleTree tree(contour.points, triangles);
  return find_crossings(contour.points, triangles, tree).pairs.size();
}

}  // namespace

TEST_CASE("no two triangles of T cross, and T has the plain contour's summary") {
  std::size_t crossed = 0, crossings_before = 0, cut = 0, unchanged = 0, long_voxels = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    const Noise noise = random_noise(seed);
    const Index3 cells = cells_of_long_voxels(noise.volume.spacing());
    long_voxels += cells != Index3{1, 1, 1};
    ContourMesh begun = build_contour(noise.volume, noise.kappa, {.usual = cells});
    const std::size_t before = crossings(begun);
    crossings_before += before;
    crossed += before > 0;
    const ContourSummary summary = build_contour(noise.volume, noise.kappa).summary;
    const std::vector<Vec3> points = begun.points;
    const ContourMesh fine = fine_contour(std::move(begun), noise.volume, noise.kappa, cells);
    CHECK(crossings(fine) == 0);
    CHECK(fine.summary.components == summary.components);
    CHECK(check_contour(fine, noise.volume, noise.kappa) == "");
    cut += fine.split_voxels;
    if (fine.split_voxels > 0) continue;
    ++unchanged;
    CHECK(fine.points == points);  // it is given back as it was
  }
  CHECK(long_voxels > 40);
  CHECK(crossed > 50);
  CHECK(crossings_before > 200);
  CHECK(cut > crossed);
  CHECK(unchanged > 50);
}

TEST_CASE("voxels are cut where they are three times as long as wide, or more") {
  CHECK(cells_of_long_voxels({2, 2, 2}) == Index3{1, 1, 1});
  CHECK(cells_of_long_voxels({1, 2.9, 1}) == Index3{1, 1, 1});
  CHECK(cells_of_long_voxels({0.5, 0.5, 1.5}) == Index3{1, 1, 2});
  CHECK(cells_of_long_voxels({5, 0.7, 0.7}) == Index3{4, 1, 1});
  CHECK(cells_of_long_voxels({1, 10, 6}) == Index3{1, 5, 3});
  CHECK(cells_of_long_voxels({1, 1, 1e300}) == Index3{1, 1, 32});
}

// `crowded` lists all voxels where triangles may cross: none cross in any other voxel, whichever
// are split.
TEST_CASE("triangles cross in crowded voxels only, also beside split ones") {
  constexpr int kSide = 7;
  std::size_t crossed = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<float> samples(kSide * kSide * kSide);
    for (float& s : samples) s = static_cast<float>(random.uniform());
    const Volume volume = Volume::from_samples<float>({kSide, kSide, kSide}, {1, 1, 1}, samples);
    const double kappa = geometric_isovalue(volume.type(), 0.5);
    ContourSplit split;
    for (int n = 0; n < 20; ++n) {
      split.voxels.push_back(random.below((kSide - 1) * (kSide - 1) * (kSide - 1)));
    }
    std::sort(split.voxels.begin(), split.voxels.end());
    split.voxels.erase(std::unique(split.voxels.begin(), split.voxels.end()), split.voxels.end());
    const int cells = 2 + static_cast<int>(random.below(6));
    split.factor = {cells, cells, cells};
    const ContourMesh contour = build_contour(volume, kappa, split);

    std::vector<std::uint8_t> is_crowded(contour.triangles.size(), 0);
    std::uint64_t before = 0;
    for (const ContourMesh::VoxelTriangles& crowd : contour.crowded) {
      REQUIRE(crowd.first < crowd.end);
      REQUIRE(crowd.end <= contour.triangles.size());
      CHECK(before <= crowd.voxel);
      before = crowd.voxel;
      std::fill(is_crowded.begin() + static_cast<std::ptrdiff_t>(crowd.first),
                is_crowded.begin() + static_cast<std::ptrdiff_t>(crowd.end), 1);
    }
    const std::vector<Triangle> triangles = contour_as_mesh(contour).mesh.triangles();
    const TriangleTree tree(contour.points, triangles);
    for (const auto& [f, g] : find_crossings(contour.points, triangles, tree).pairs) {
      ++crossed;
      CHECK(is_crowded[f]);
      CHECK(is_crowded[g]);
    }
  }
  CHECK(crossed > 20);
}
