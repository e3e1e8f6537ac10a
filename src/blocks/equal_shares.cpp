// SPDX-License-Identifier: MIT
#include "blocks/equal_shares.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/parallel.h"

namespace deliso {
namespace {

constexpr int kCell = SurfaceWork::kCellVoxels;
constexpr int kSlabCells = 4;  // in a slab that is read

// In every layer every 16th row is looked at; in the next layer the one 11 further on. So 16 layers
// have all rows, and no regular pattern of the volume is missed or met each time.
constexpr int kRowsApart = 16, kRowsPerLayer = 11;

// The work of a sample that is alone on its side along an axis: both its edges are crossed. Thin
// sheets keep most of their vertices, and need most of the tests. A fit to the seconds of 1,600
// blocks of five scans gives 37. Without it, TOOTH's heaviest block is estimated at a quarter of
// its time. 20 and 40 give grids no better than 30.
constexpr int kThinWork = 30;

// Twice the work of a seam, in layers of voxels there: 1.5 layers. With 1 layer ENGINE has up to
// twice as many blocks, more vertices, and as much speed on 16 threads.
constexpr std::uint64_t kSeamLayersTwice = 3;

// A block with so little work takes a fiftieth of a second: no thread waits for it.
constexpr std::uint64_t kSmallWork = 8000;

// A block with more work than this leaves a core's caches: a vertex of noise takes a fifth longer
// there. What is above it costs so much that no seams outweigh it.
constexpr std::uint64_t kLargeWork = 200000, kLargeCost = 1000;

int rounded_up(int n) {
  return (n + kCell - 1) / kCell * kCell;
}
int rounded_down(int n) {
  return n / kCell * kCell;
}

using Row = std::vector<std::uint8_t>;

// Sets twice the work at each sample of a row: each crossed edge counts at both its ends. `here` is
// 1 for samples inside, also for one before the row and one after it. `beside`: those next to it
// along y and z. Bytes without a branch become vector instructions.
void add_up(const std::uint8_t* here, const std::array<Row, 4>& beside, Row& twice_work) {
  constexpr int kMostEnds = 6, kAxes = 3;
  static_assert(kMostEnds + kAxes * 2 * kThinWork <= std::numeric_limits<std::uint8_t>::max());
  const auto [y0, y1, z0, z1] =
      std::array{beside[0].data(), beside[1].data(), beside[2].data(), beside[3].data()};
  std::uint8_t* const to = twice_work.data();
  const std::size_t size = twice_work.size();
  const std::uint8_t *const before = here - 1, *const after = here + 1;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint8_t s = here[i];
    const int a = s ^ before[i], b = s ^ after[i], c = s ^ y0[i], d = s ^ y1[i], e = s ^ z0[i],
              f = s ^ z1[i];
    const int thin = (a & b) + (c & d) + (e & f);
    to[i] = static_cast<std::uint8_t>(a + b + c + d + e + f + 2 * kThinWork * thin);
  }
}

// The planes that cut an axis into some number of blocks.
struct AxisPlanes {
  std::vector<int> at;
  std::uint64_t work_cut = 0;  // in the layers of voxels at the inner ones
};

AxisPlanes planes_along(const SurfaceWork& work, int axis, int blocks) {
  SampleBox before = work.all();
  const int length = before.end[axis];
  const int begin = work.active().begin[axis], end = work.active().end[axis];
  const auto work_before = [&](int plane) {
    before.end[axis] = plane;
    return work.in(before);
  };
  const std::uint64_t all = work_before(end);
  AxisPlanes planes{{0}};
  for (int n = 1; n < blocks; ++n) {
    const int last = std::max(begin, planes.at.back()), left = blocks - n;
    // Both ends leave room for the other blocks.
    int plane = rounded_up(std::max(last + kLeastBlockSamples, end - left * kMostBlockVoxels));
    const int highest =
        rounded_down(std::min(last + kMostBlockVoxels, end - left * kLeastBlockSamples));
    // The next one is nearer to the share while the middle between both lies before it.
    const auto is_early = [&] {
      return (work_before(plane) + work_before(plane + kCell)) * blocks < 2 * all * n;
    };
    while (plane < highest && is_early()) plane += kCell;
    planes.at.push_back(plane);
    SampleBox around = work.all();
    around.begin[axis] = plane - kCell;
    around.end[axis] = plane + kCell;
    planes.work_cut += work.in(around) / (around.end[axis] - around.begin[axis]);
  }
  planes.at.push_back(length);
  return planes;
}

// Returns the planes for each number of blocks that the bounds of their sides allow.
std::vector<AxisPlanes> all_planes_along(const SurfaceWork& work, int axis) {
  const int length = work.active().end[axis] - work.active().begin[axis];
  const int least = std::max(1, (length + kMostBlockVoxels - 1) / kMostBlockVoxels);
  const int most = std::max(1, length / kLeastBlockSamples);
  std::vector<AxisPlanes> all;
  for (int blocks = least; blocks <= most; ++blocks) {
    all.push_back(planes_along(work, axis, blocks));
  }
  return all;
}

// Returns the work of the heaviest block, or of one that has `enough`.
std::uint64_t heaviest(const SurfaceWork& work, const std::vector<int>& x,
                       const std::vector<int>& y, const std::vector<int>& z, std::uint64_t enough) {
  std::uint64_t most = 0;
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        most = std::max(most, work.in({{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}}));
        if (most >= enough) return most;
      }
    }
  }
  return most;
}

}  // namespace

SurfaceWork::SurfaceWork(const VolumeSource& source, double isovalue, int threads)
    : voxels_(source.shape.voxels()) {
  for (int axis = 0; axis < 3; ++axis) cells_[axis] = rounded_up(voxels_[axis]) / kCellVoxels;
  sums_.resize(at(cells_) + 1);
  for_each_run(threads, cells_.k, kSlabCells, [&](std::size_t begin, std::size_t end) {
    const bool is_last = static_cast<int>(end) == cells_.k;
    const int first = kCellVoxels * static_cast<int>(begin);
    const int last = is_last ? voxels_.k : kCellVoxels * static_cast<int>(end) - 1;
    const SampleBox box{{0, 0, std::max(first - 1, 0)},
                        {voxels_.i, voxels_.j, std::min(last + 1, voxels_.k)}};
    const Volume slab = source.in_memory ? *source.in_memory : source.read(box);
    slab.visit([&]<class Sample>(const Sample* samples) {
      const std::optional<Sample> threshold = inside_threshold<Sample>(isovalue);
      if (!threshold) return;
      for (int k = first; k <= last; ++k) {
        add_layer(slab, samples, *threshold, k - slab.first().k);
      }
    });
  });
  sum_up();
  find_active();
}

// Adds the work in a layer of the slab to the cells.
template <class Sample>
void SurfaceWork::add_layer(const Volume& slab, const Sample* samples, Sample threshold, int k) {
  const Index3 dims = slab.dims();
  const int layer = slab.first().k + k;
  const auto row_size = static_cast<std::size_t>(dims.i);
  // 1 for samples inside, in the row and in those before and after it along y and z. Beyond
  // the volume are copies of its last samples: the surface crosses no edge there.
  Row row(row_size + 2);
  std::array<Row, 4> beside;
  beside.fill(Row(row_size));
  Row twice_work(row_size);
  const auto read = [&](std::uint8_t* to, int j, int at_k) {
    const Sample* from =
        samples + slab.index(0, std::clamp(j, 0, dims.j - 1), std::clamp(at_k, 0, dims.k - 1));
    for (int i = 0; i < dims.i; ++i) to[i] = from[i] >= threshold;
  };
  for (int j = layer * kRowsPerLayer % kRowsApart; j < dims.j; j += kRowsApart) {
    read(row.data() + 1, j, k);
    row.front() = row[1];
    row.back() = row[row_size];
    read(beside[0].data(), j - 1, k);
    read(beside[1].data(), j + 1, k);
    read(beside[2].data(), j, k - 1);
    read(beside[3].data(), j, k + 1);
    add_up(row.data() + 1, beside, twice_work);
    for (int cell = 0; cell < cells_.i; ++cell) {
      const int begin = cell * kCellVoxels;
      const int end = cell + 1 == cells_.i ? dims.i : begin + kCellVoxels;
      unsigned sum = 0;
      for (int i = begin; i < end; ++i) sum += twice_work[i];
      const Index3 corner{cell + 1, std::min(j / kCellVoxels + 1, cells_.j),
                          std::min(layer / kCellVoxels + 1, cells_.k)};
      sums_[at(corner)] += sum;
    }
  }
}

void SurfaceWork::sum_up() {
  for (int axis = 0; axis < 3; ++axis) {
    Index3 step;
    step[axis] = 1;
    for_each_place(step, cells_, [&](Index3 to) {
      sums_[at(to)] += sums_[at({to.i - step.i, to.j - step.j, to.k - step.k})];
    });
  }
}

void SurfaceWork::find_active() {
  const SampleBox whole{{0, 0, 0}, {kCell * cells_.i, kCell * cells_.j, kCell * cells_.k}};
  if (in(whole) == 0) return;
  active_ = whole;
  for (int axis = 0; axis < 3; ++axis) {
    SampleBox layer = whole;
    const auto is_empty = [&](int cell) {
      layer.begin[axis] = kCell * cell;
      layer.end[axis] = layer.begin[axis] + kCell;
      return in(layer) == 0;
    };
    int first = 0, last = cells_[axis] - 1;
    while (is_empty(first)) ++first;
    while (is_empty(last)) --last;
    active_.begin[axis] = kCell * first;
    active_.end[axis] = kCell * (last + 1);
  }
}

std::uint64_t SurfaceWork::in(const SampleBox& box) const {
  Index3 lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = box.begin[axis] / kCellVoxels;
    hi[axis] = rounded_up(box.end[axis]) / kCellVoxels;
  }
  const auto before = [&](int i, int j, int k) { return sums_[at({i, j, k})]; };
  const std::uint64_t ends = before(hi.i, hi.j, hi.k) - before(lo.i, hi.j, hi.k) -
                             before(hi.i, lo.j, hi.k) - before(hi.i, hi.j, lo.k) +
                             before(lo.i, lo.j, hi.k) + before(lo.i, hi.j, lo.k) +
                             before(hi.i, lo.j, lo.k) - before(lo.i, lo.j, lo.k);
  return ends * kRowsApart / 2;
}

BlockGrid grid_at_equal_shares(const SurfaceWork& work) {
  std::array<std::vector<AxisPlanes>, 3> choices;
  for (int axis = 0; axis < 3; ++axis) choices[axis] = all_planes_along(work, axis);
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::array<const AxisPlanes*, 3> best{};
  for (const AxisPlanes& z : choices[2]) {
    for (const AxisPlanes& y : choices[1]) {
      for (const AxisPlanes& x : choices[0]) {
        const std::uint64_t seams = kSeamLayersTwice * (x.work_cut + y.work_cut + z.work_cut);
        if (seams + 2 * kSmallWork >= least) continue;
        const std::uint64_t enough = (least - seams) / 2 + 1;
        const std::uint64_t most = heaviest(work, x.at, y.at, z.at, enough);
        const std::uint64_t cost = seams + 2 * std::max(kSmallWork, most) +
                                   kLargeCost * (std::max(kLargeWork, most) - kLargeWork);
        if (cost >= least) continue;
        least = cost;
        best = {&x, &y, &z};
      }
    }
  }
  return BlockGrid({best[0]->at, best[1]->at, best[2]->at});
}

}  // namespace deliso
