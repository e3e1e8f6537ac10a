// SPDX-License-Identifier: MIT
// The kd-tree against all voxels: the voxels that it collects along random and hard segments, the
// chain of pieces, its memory. Isovalues are random; volumes have many shapes and all sample types.
#include "kdtree/voxel_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../isosurface/fields.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

bool same(const VoxelSpan& a, const VoxelSpan& b) {
  return a.voxel == b.voxel && a.t0 == b.t0 && a.t1 == b.t1 && a.u0 == b.u0 && a.u1 == b.u1;
}

// Pieces of all voxels, in order along the line.
std::vector<VoxelSpan> all_pieces(const LatticeLine& line, const Volume& volume) {
  std::vector<VoxelSpan> spans;
  const Index3 n = volume.voxels();
  if (!line.valid()) return spans;
  for_each_index(n, [&](int i, int j, int k) {
    if (const auto span = line.span({i, j, k}, {0, 1}); !span.empty()) spans.push_back(span);
  });
  std::sort(spans.begin(), spans.end(),
            [](const VoxelSpan& a, const VoxelSpan& b) { return a.t0 < b.t0; });
  return spans;
}

bool is_active(const Volume& volume, Index3 voxel, double kappa) {
  const Corners c = volume.corners(voxel);
  const auto inside = std::count_if(c.begin(), c.end(), [&](double v) { return v >= kappa; });
  return inside > 0 && inside < 8;
}

// Where one piece ends the next begins, at the same point seen from both voxels (L2, L3).
bool is_chain(const std::vector<VoxelSpan>& spans) {
  for (std::size_t n = 0; n + 1 < spans.size(); ++n) {
    const VoxelSpan &a = spans[n], &b = spans[n + 1];
    if (a.t1 != b.t0 || a.voxel == b.voxel) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const int step = b.voxel[axis] - a.voxel[axis];
      if (step == 0 ? a.u1[axis] != b.u0[axis]
                    : std::abs(step) != 1 || a.u1[axis] != (step > 0) || b.u0[axis] != (step < 0))
        return false;
    }
  }
  return true;
}

template <class T>
Volume random_volume(Random& random, double lo, double hi) {
  // Long, flat, thin, and without voxels at all.
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis)
    dims[axis] = 1 + static_cast<int>(random.below(random.below(3) == 0 ? 40 : 9));
  const Vec3 spacing{random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3)};
  // Mostly empty, so that the tree can prune.
  return sampled<T>(dims, spacing, [&](int, int, int) {
    return random.below(20) == 0 ? random.uniform(lo, hi) : lo;
  });
}

std::size_t check_volume(const Volume& volume, double kappa, std::uint64_t seed, int segments) {
  CAPTURE(seed);
  CAPTURE(volume.dims().i);
  CAPTURE(volume.dims().j);
  CAPTURE(volume.dims().k);
  CAPTURE(kappa);
  const VoxelTree tree(volume);
  Random random(seed);
  std::vector<VoxelSpan> collected;
  std::size_t total = 0;
  for (int n = 0; n < segments; ++n) {
    CAPTURE(n);
    const Segment r = hard_segment(random, volume);
    std::vector<VoxelSpan> expected = all_pieces(tree.lattice_line(r.a, r.direction()), volume);
    REQUIRE(is_chain(expected));
    std::erase_if(expected, [&](const VoxelSpan& s) { return !is_active(volume, s.voxel, kappa); });
    tree.collect_voxels(r, kappa, collected);
    REQUIRE(collected.size() == expected.size());
    for (std::size_t m = 0; m < collected.size(); ++m) REQUIRE(same(collected[m], expected[m]));
    total += collected.size();
  }
  return total;
}

// True if the samples at the corners of the box's voxels lie on both sides of kappa.
bool is_active(const Volume& volume, const VoxelBox& box, double kappa) {
  bool any_inside = false, all_inside = true;
  for (int k = box.lo[2]; k <= box.hi[2]; ++k) {
    for (int j = box.lo[1]; j <= box.hi[1]; ++j) {
      for (int i = box.lo[0]; i <= box.hi[0]; ++i) {
        const bool is_inside = volume.sample(i, j, k) >= kappa;
        any_inside |= is_inside;
        all_inside &= is_inside;
      }
    }
  }
  return any_inside && !all_inside;
}

// The piece of the line in the box.
Range clip(const LatticeLine& line, const VoxelBox& box) {
  Range range{0, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = line.at_plane(axis, box.lo[axis]), b = line.at_plane(axis, box.hi[axis]);
    range = {std::max(range.lo, std::min(a, b)), std::min(range.hi, std::max(a, b))};
  }
  return range;
}

// What a search looks at.
struct SearchCost {
  std::vector<VoxelBox> nodes;
  std::vector<VoxelSpan> voxels;

  void operator()(const VoxelBox& box) { nodes.push_back(box); }
  bool operator()(const VoxelSpan& span) {
    voxels.push_back(span);
    return false;
  }
};

}  // namespace

TEST_CASE("collect_voxels finds exactly the active voxels on the segment, in order") {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const double kappa = random.uniform(-5, 100);
    const auto run = [&]<class T>(T, double lo, double hi, double at) {
      total += check_volume(random_volume<T>(random, lo, hi), at, seed, 40);
    };
    switch (seed % 8) {
      case 0:
        run(std::uint8_t{}, 0, 255, kappa);
        break;
      case 1:
        run(std::int8_t{}, -128, 127, kappa - 30);
        break;
      case 2:
        run(std::uint16_t{}, 0, 300, std::round(kappa));
        break;
      case 3:
        run(std::int16_t{}, -3, 300, kappa);
        break;
      case 4:
        run(std::uint32_t{}, 0, 4e9, 4e7 * kappa);
        break;
      case 5:
        run(std::int32_t{}, -2e9, 2e9, 1e7 * kappa);
        break;
      case 6:
        run(float{}, -1, 1, 0.01 * kappa);
        break;
      default:
        run(double{}, 0, 1e-3, 1e-5 * kappa);
        break;
    }
  }
  MESSAGE("voxels collected: " << total);
  CHECK(total > 20'000);
}

// The oracle above has its pieces from the line itself.
TEST_CASE("a line in a plane of samples is in the voxels above it, in the box's far side below") {
  const Index3 voxels{3, 4, 5};
  for (int axis = 0; axis < 3; ++axis) {
    for (int plane = 0; plane <= voxels[axis]; ++plane) {
      Vec3 from{0.3, 0.4, 0.2}, direction{2.5, 3.1, 4.4};
      from[axis] = plane;
      direction[axis] = 0;
      const LatticeLine line(from, direction, voxels);
      Range passed{1, 0};
      for_each_index(voxels, [&](int i, int j, int k) {
        const VoxelSpan span = line.span({i, j, k}, {0, 1});
        if (span.empty()) return;
        REQUIRE(span.voxel[axis] == std::min(plane, voxels[axis] - 1));
        passed = {std::min(passed.lo, span.t0), std::max(passed.hi, span.t1)};
      });
      CHECK(passed.lo == 0);
      CHECK(passed.hi == 1);
    }
  }
}

// Without any pruning the voxels are the same; only the time is not.
TEST_CASE("a search opens only nodes that the line passes and whose samples straddle kappa") {
  std::size_t opened = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // A ball in a corner, of a few per cent of the volume.
    const Index3 dims{24 + static_cast<int>(random.below(20)), 30, 26};
    const double radius = random.uniform(3, 9), kappa = 0;
    const Volume volume = sampled<float>(dims, {1, 1, 1}, [&](int i, int j, int k) {
      return radius - std::sqrt((i - 10) * (i - 10) + (j - 9) * (j - 9) + (k - 11) * (k - 11));
    });
    const VoxelTree tree(volume);
    for (int n = 0; n < 10; ++n) {
      CAPTURE(n);
      const Segment r = hard_segment(random, volume);
      const LatticeLine line = tree.lattice_line(r.a, r.direction());
      SearchCost cost;
      volume.visit([&](const auto* samples) {
        using T = std::remove_cvref_t<decltype(*samples)>;
        tree.find_along(line, line.clip({0, 1}), samples, *inside_threshold<T>(kappa), cost);
      });
      for (const VoxelBox& box : cost.nodes) {
        REQUIRE(is_active(volume, box, kappa));
        const Range piece = clip(line, box);
        REQUIRE(piece.lo < piece.hi);
      }
      // Every voxel found is in a leaf opened (K2).
      for (const VoxelSpan& span : cost.voxels) {
        REQUIRE(std::any_of(cost.nodes.begin(), cost.nodes.end(), [&](const VoxelBox& box) {
          std::int64_t voxels = 1;
          bool is_inside = true;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const int at = span.voxel[static_cast<int>(axis)];
            is_inside &= box.lo[axis] <= at && at < box.hi[axis];
            voxels *= box.hi[axis] - box.lo[axis];
          }
          return is_inside && voxels <= VoxelTree::kLeafVoxels;
        }));
      }
      opened += cost.nodes.size();
    }
  }
  CHECK(opened > 300);
}

TEST_CASE("a sample equal to kappa counts as inside") {
  // One voxel; its only sample that is not below kappa equals it.
  const std::vector<std::uint8_t> samples{1, 1, 1, 1, 1, 1, 1, 7};
  const Volume volume = Volume::from_samples({2, 2, 2}, {1, 1, 1}, samples);
  const VoxelTree tree(volume);
  CHECK(tree.active(7));
  CHECK(!tree.active(7.5));
  CHECK(!tree.active(1));
  std::vector<VoxelSpan> spans;
  tree.collect_voxels({{0.1, 0.2, 0.3}, {0.9, 0.8, 0.7}}, 7, spans);
  CHECK(spans.size() == 1);
  tree.collect_voxels({{0.1, 0.2, 0.3}, {0.9, 0.8, 0.7}}, 1, spans);
  CHECK(spans.empty());
}

TEST_CASE("a threshold and kappa find the same samples inside, at kappa and next to it") {
  Random random(3);
  for (int trial = 0; trial < 100'000; ++trial) {
    const double kappa = random.uniform(-130, 130);
    const int rounded = static_cast<int>(kappa);
    for (int step = -2; step <= 2; ++step) {
      const int v = std::clamp(rounded + step, -128, 127);
      if (kappa <= 127) REQUIRE((v >= inside_threshold<std::int8_t>(kappa)) == (v >= kappa));
      float f = static_cast<float>(kappa);
      for (int n = 0; n < std::abs(step); ++n) f = std::nextafter(f, step < 0 ? -1e9f : 1e9f);
      REQUIRE((f >= inside_threshold<float>(kappa)) == (static_cast<double>(f) >= kappa));
    }
  }
}

TEST_CASE("memory stays well under a tenth of the volume") {
  for (const Index3 dims : {Index3{64, 64, 64},
                            {103, 94, 161},
                            {256, 256, 98},
                            {129, 65, 33},
                            {341, 341, 93},
                            {2, 2, 5000},
                            {500, 500, 2},
                            {100, 101, 102}}) {
    CAPTURE(dims.i);
    CAPTURE(dims.k);
    const Volume volume = Volume::from_samples(
        dims, {1, 1, 1},
        std::vector<std::uint8_t>(static_cast<std::size_t>(dims.i * dims.j * dims.k)));
    const VoxelTree tree(volume);
    CHECK(static_cast<double>(tree.bytes()) <= 0.08 * static_cast<double>(volume.sample_count()));
  }
}
