// SPDX-License-Identifier: MIT
// Grids of blocks whose planes lie at equal shares of the surface's work.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "blocks/equal_shares.h"
#include "blocks/mesh_in_blocks.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "mesh/meshes.h"

using namespace deliso;
using test::same_mesh;

namespace {

// Cubes of four samples a side, inside and outside by turns, in samples `begin` to `end`.
Volume checkered(Index3 dims, Index3 end, Index3 begin = {0, 0, 0}) {
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < dims.k; ++k) {
    for (int j = 0; j < dims.j; ++j) {
      for (int i = 0; i < dims.i; ++i) {
        const bool is_within =
            i >= begin.i && j >= begin.j && k >= begin.k && i < end.i && j < end.j && k < end.k;
        samples.push_back(is_within && (i / 4 + j / 4 + k / 4) % 2 == 0 ? 200 : 0);
      }
    }
  }
  return Volume::from_samples(dims, {1, 1, 1}, samples);
}

constexpr double kIsovalue = 100.5;

BlockGrid grid_of(const VolumeSource& source, int threads = 1) {
  Options options;
  options.threads = threads;
  return block_grid(source, kIsovalue, options);
}

std::vector<std::uint64_t> work_in_blocks(const SurfaceWork& work, const BlockGrid& grid) {
  std::vector<std::uint64_t> all;
  for (const SampleBox& box : grid.boxes()) all.push_back(work.in(box));
  return all;
}

}  // namespace

TEST_CASE("planes ascend, and blocks have 24 samples to 128 voxels around the surface") {
  const Volume cases[] = {
      checkered({96, 96, 96}, {96, 96, 96}),                   // as fine as it can be
      checkered({200, 97, 71}, {40, 40, 40}),                  // all of it in one corner
      checkered({201, 90, 60}, {201, 90, 60}, {150, 40, 30}),  // in the last one
      checkered({257, 130, 49}, {257, 20, 49}),
      checkered({300, 2, 2}, {300, 2, 2}),  // one voxel along two axes
      checkered({513, 9, 23}, {100, 9, 23}),
      checkered({60, 60, 60}, {0, 0, 0}),  // no surface
  };
  for (const Volume& volume : cases) {
    const Index3 dims = volume.dims();
    CAPTURE(dims.i);
    const BlockGrid grid = grid_of(source_of(volume));
    const SampleBox active = SurfaceWork(source_of(volume), kIsovalue, 1).active();
    for (int axis = 0; axis < 3; ++axis) {
      CAPTURE(axis);
      const std::vector<int>& planes = grid.planes[axis];
      REQUIRE(planes.size() >= 2);
      CHECK(planes.front() == 0);
      CHECK(planes.back() == dims[axis] - 1);
      for (std::size_t n = 1; n < planes.size(); ++n) {
        const int voxels = planes[n] - planes[n - 1];
        const int around =
            std::min(planes[n], active.end[axis]) - std::max(planes[n - 1], active.begin[axis]);
        CHECK(around <= kMostBlockVoxels);
        // The last cell of the surface's box may be a cut one.
        CHECK(voxels + SurfaceWork::kCellVoxels >= std::min(kLeastBlockSamples, dims[axis]));
      }
    }
  }
}

TEST_CASE("a volume without a surface, or with a small one, has as few blocks as may be") {
  CHECK(grid_of(source_of(checkered({120, 120, 120}, {0, 0, 0}))).cells() == Index3{1, 1, 1});
  // A cube of 30 samples a side: 5400 crossed edges.
  const Volume cube =
      Volume::from_function({{0, 0, 0}, {60, 60, 60}}, {61, 61, 61}, [](const Vec3& p) {
        const auto is_within = [](double x) { return 15 <= x && x < 45; };
        return is_within(p.x) && is_within(p.y) && is_within(p.z) ? 200 : 0;
      });
  CHECK(grid_of(source_of(cube)).cells() == Index3{1, 1, 1});
}

TEST_CASE("blocks of a surface that is everywhere have equal shares") {
  const VolumeSource source = source_of(checkered({129, 129, 129}, {129, 129, 129}));
  const SurfaceWork work(source, kIsovalue, 1);
  const BlockGrid grid = grid_of(source);
  const std::vector<std::uint64_t> shares = work_in_blocks(work, grid);
  CHECK(shares.size() >= 27);
  const auto [least, most] = std::ranges::minmax(shares);
  CHECK(static_cast<double>(most) < 2 * static_cast<double>(least));
}

TEST_CASE("a surface in one corner is divided where it is") {
  const VolumeSource source = source_of(checkered({161, 161, 161}, {64, 64, 64}));
  const SurfaceWork work(source, kIsovalue, 1);
  const BlockGrid grid = grid_of(source);
  const auto all = static_cast<double>(work.in(work.all()));
  CHECK(static_cast<double>(std::ranges::max(work_in_blocks(work, grid))) < .25 * all);
  // One block of equal sides would have all of it.
  const SampleBox corner{{0, 0, 0}, {80, 80, 80}};
  CHECK(static_cast<double>(work.in(corner)) == all);
}

TEST_CASE("the work is the number of crossed edges, and more where sheets are thin") {
  // Planes of samples four apart along x: an edge in four is crossed, and no other.
  const auto layers = [](int thick) {
    return Volume::from_function({{0, 0, 0}, {64, 64, 64}}, {65, 65, 65}, [=](const Vec3& p) {
      return static_cast<int>(p.x) % 8 < thick ? 200 : 0;
    });
  };
  const auto work_of = [](const Volume& volume) {
    const SurfaceWork work(source_of(volume), kIsovalue, 1);
    return static_cast<double>(work.in(work.all()));
  };
  const double edges = 65 * 65 * 16;
  CHECK(work_of(layers(4)) == doctest::Approx(edges).epsilon(0.02));
  CHECK(work_of(layers(1)) > 10 * edges);
}

TEST_CASE("dense noise of 96 samples a side is divided") {
  const Volume noise = make_builtin_volume("builtin:noise:96");
  const BlockGrid grid = block_grid(source_of(noise), 127.5, {});
  CHECK(grid.boxes().size() >= 27);
}

TEST_CASE("however much the seams are in dense noise blocks stay small") {
  const VolumeSource source = source_of(make_builtin_volume("builtin:noise:144"));
  const SurfaceWork work(source, 127.5, 1);
  const BlockGrid grid = block_grid(source, 127.5, {});
  CHECK(std::ranges::max(work_in_blocks(work, grid)) <= 200000);
}

TEST_CASE("the grid is the same read box by box, and on any number of threads") {
  for (const Index3 dims : {Index3{70, 60, 65}, Index3{64, 33, 161}, Index3{50, 50, 2}}) {
    const VolumeSource whole = source_of(checkered(dims, {dims.i, dims.j, dims.k / 2 + 1}));
    VolumeSource by_boxes = whole;
    by_boxes.in_memory.reset();
    const SurfaceWork work(whole, kIsovalue, 1), read(by_boxes, kIsovalue, 3);
    for (int k = 0; k < dims.k - 1; k += 8) {
      const SampleBox slab{{0, 0, k}, {dims.i - 1, dims.j - 1, std::min(k + 8, dims.k - 1)}};
      CHECK(work.in(slab) == read.in(slab));
    }
    CHECK(grid_of(whole).planes == grid_of(by_boxes, 3).planes);
  }
}

TEST_CASE("large volumes, and sides that are asked for, need no look at the samples") {
  const Grid large({1 << 16, 66, 66}, {1, 1, 1}, SampleType::u8);
  const VolumeSource unread{large, [](const SampleBox&) -> Volume { throw InputError("read"); }};
  CHECK(block_grid(unread, kIsovalue, {}).cells() == Index3{512, 1, 1});
  const Grid small({61, 61, 61}, {1, 1, 1}, SampleType::u8);
  Options options;
  options.block_side = 20;
  CHECK(block_grid({small, unread.read}, kIsovalue, options).cells() == Index3{3, 3, 3});
  CHECK_THROWS_AS(block_grid({small, unread.read}, kIsovalue, {}), InputError);
}

TEST_CASE("parts of a volume whose samples decide the grid make the mesh of one process") {
  const Volume volume =
      Volume::from_function({{0, 0, 0}, {1, 1, 1}}, {61, 45, 53}, [](const Vec3& p) {
        return std::sin(30 * p.x) * std::cos(24 * p.y) + std::sin(24 * p.y) * std::cos(27 * p.z) +
               std::sin(27 * p.z) * std::cos(30 * p.x);
      });
  const VolumeSource all = source_of(volume);
  Options options;
  options.threads = 1;
  REQUIRE(block_grid(all, 0, options).boxes().size() > 1);
  CHECK(box_of_part(all.shape, options, {1, 2}) == SampleBox{{0, 0, 0}, {60, 44, 52}});
  const VolumeSource by_boxes{all.shape, all.read};
  std::vector<Block> parts;
  for (int n = 1; n <= 2; ++n) parts.push_back(mesh_part(by_boxes, 0, options, {n, 2}));
  Report report;
  const TriMesh joined = mesh_of_parts(by_boxes, 0, options, std::move(parts), report);
  CHECK(same_mesh(joined, mesh_isosurface(volume, 0, options)));
}
