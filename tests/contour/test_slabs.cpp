// SPDX-License-Identifier: MIT
// T made in threads, slab by slab, is what one walk makes, number by number.
#include "contour/slabs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "contour/block_order.h"
#include "contour/contour.h"

using namespace deliso;

namespace {

// Noise, or waves with sheets through all slabs and blobs that end where slabs meet.
Volume random_volume(std::uint64_t seed, Index3 dims) {
  Random random(seed);
  std::vector<float> samples;
  for (int k = 0; k < dims.k; ++k) {
    for (int j = 0; j < dims.j; ++j) {
      for (int i = 0; i < dims.i; ++i) {
        const double wave = std::sin(0.3 * i) + std::sin(0.4 * j + 0.1 * k) + std::cos(0.35 * k);
        const double value = seed % 3 == 0 ? wave : wave / 3 + random.uniform(-1, 1);
        samples.push_back(static_cast<float>(seed % 2 == 0 ? value : std::round(4 * value)));
      }
    }
  }
  return Volume::from_samples(dims, {1, 1.5, 0.7}, samples);
}

void check_same(const ContourMesh& a, const ContourMesh& b) {
  CHECK(a.summary == b.summary);
  CHECK(a.points == b.points);
  CHECK(a.component == b.component);
  CHECK(a.box_faces == b.box_faces);
  CHECK(a.triangles == b.triangles);
  CHECK(a.boundary.first == b.boundary.first);
  CHECK(a.boundary.vertices == b.boundary.vertices);
  CHECK(a.boundary.face == b.boundary.face);
  CHECK(a.boundary.on_box_edge == b.boundary.on_box_edge);
  CHECK(a.boundary.component == b.boundary.component);
  CHECK(a.split_voxels == b.split_voxels);
  using Crowd = ContourMesh::VoxelTriangles;
  CHECK(std::equal(a.crowded.begin(), a.crowded.end(), b.crowded.begin(), b.crowded.end(),
                   [](const Crowd& c, const Crowd& d) {
                     return c.voxel == d.voxel && c.first == d.first && c.end == d.end;
                   }));
}

}  // namespace

TEST_CASE("slabs hold every layer once, in order") {
  for (const int threads : {1, 2, 3, 8, 100}) {
    for (const int layers : {1, 2, 17, 100, 1000}) {
      const auto odd = [](int k) { return k % 2 != 0; };
      const std::vector<Slab> slabs = cut_into_slabs({200, 100, layers}, threads, odd);
      CHECK(slabs.front().begin == 0);
      CHECK(slabs.back().end == layers);
      for (std::size_t n = 1; n < slabs.size(); ++n) {
        CHECK(slabs[n].begin == slabs[n - 1].end);
        CHECK(odd(slabs[n].begin));
      }
      if (threads == 1) CHECK(slabs.size() == 1);
      if (threads == 8 && layers == 1000) CHECK(slabs.size() > 10);
    }
  }
}

TEST_CASE("T is the same with any number of threads") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Index3 dims{40 + static_cast<int>(seed), 45, 280};
    const Volume volume = random_volume(seed, dims);
    REQUIRE(cut_into_slabs(dims, 3, [](int) { return true; }).size() > 5);
    const double kappa = geometric_isovalue(volume.type(), 0.5);
    const ContourMesh one = build_contour(volume, kappa, 1);
    ContourMesh ordered = one;
    order_by_blocks(ordered, volume, 1);
    for (const int threads : {2, 3, 8}) {
      CAPTURE(threads);
      ContourMesh several = build_contour(volume, kappa, threads);
      check_same(several, one);
      CHECK(summarize_contour(volume, kappa, threads) == one.summary);
      order_by_blocks(several, volume, threads);
      check_same(several, ordered);
    }
  }
}

TEST_CASE("T in cells is the same with any number of threads") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Index3 dims{40, 45, 280};
    const Volume volume = random_volume(seed, dims);
    const double kappa = geometric_isovalue(volume.type(), 0.5);
    Random random(seed);
    ContourSplit split;
    split.factor = {2, 3, 4};
    if (seed % 4 == 0) split.elsewhere = {1, 1, 2};
    // Few, so that slabs may begin between them, or in nearly every layer.
    const int count = seed % 2 == 0 ? 20 : 2000;
    for (int n = 0; n < count; ++n) split.voxels.push_back(random.below(39 * 44 * 279));
    std::sort(split.voxels.begin(), split.voxels.end());
    const ContourMesh one = build_contour(volume, kappa, split, 1);
    CHECK(one.split_voxels > 0);
    for (const int threads : {2, 3, 8}) {
      CAPTURE(threads);
      check_same(build_contour(volume, kappa, split, threads), one);
    }
  }
}
