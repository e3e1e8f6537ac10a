// SPDX-License-Identifier: MIT
#include "kdtree/voxel_tree.h"

#include <algorithm>

#include "base/cancel.h"

namespace deliso {
namespace {

// Where the leaves' bricks begin along one axis, and one more: the last one's end. With each brick
// the bits that its number contributes to the index of its leaf.
struct AxisCuts {
  std::vector<int> cut;
  std::vector<std::size_t> code;
};

// Halves lo .. hi as the traversal does, on the levels that split this axis.
void add_cuts(AxisCuts& cuts, int lo, int hi, std::size_t code,
              const std::vector<std::size_t>& bits, std::size_t level) {
  if (level == bits.size()) {
    cuts.cut.push_back(lo);
    cuts.code.push_back(code);
    return;
  }
  const int middle = lo + (hi - lo) / 2;
  add_cuts(cuts, lo, middle, code, bits, level + 1);
  add_cuts(cuts, middle, hi, code | bits[level], bits, level + 1);
}

}  // namespace

VoxelTree::VoxelTree(const Volume& volume) : volume_(volume), units_(volume) {
  choose_axes();
  volume.visit([&](const auto* samples) { build(samples); });
}

void VoxelTree::choose_axes() {
  const Index3 voxels = volume_.voxels();
  if (voxels.i < 1 || voxels.j < 1 || voxels.k < 1) return;
  // The longest and shortest sides of the nodes at the current level.
  std::array<std::int64_t, 3> longest = {voxels.i, voxels.j, voxels.k}, shortest = longest;
  while (longest[0] * longest[1] * longest[2] > kLeafVoxels) {
    // Ties go to z, then y: bricks longer in x touch fewer cache lines.
    std::size_t axis = 2;
    for (const std::size_t other : {1u, 0u})
      if (longest[other] > longest[axis]) axis = other;
    if (shortest[axis] < 2) break;
    axis_[depth_++] = static_cast<std::uint8_t>(axis);
    longest[axis] = (longest[axis] + 1) / 2;
    shortest[axis] /= 2;
  }
}

template <class T>
void VoxelTree::build(const T* samples) {
  const Index3 dims = volume_.dims(), voxels = volume_.voxels();
  const std::size_t leaves = std::size_t{1} << depth_;
  auto& nodes = nodes_.emplace<Nodes<T>>(2 * leaves, MinMax<T>{samples[0], samples[0]});
  if (voxels.i < 1 || voxels.j < 1 || voxels.k < 1) return;

  std::array<AxisCuts, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::size_t> bits;
    for (int level = 0; level < depth_; ++level)
      if (axis_[level] == axis) bits.push_back(std::size_t{1} << (depth_ - 1 - level));
    const int end = voxels[static_cast<int>(axis)];
    add_cuts(axes[axis], 0, end, 0, bits, 0);
    axes[axis].cut.push_back(end);
  }

  // One row of bricks along x at a time. First reduces its sample rows to one, element by element
  // (which vectorizes), then that row brick by brick.
  // Locals only: bytes may alias the members of a vector, and then nothing vectorizes.
  const std::size_t row = dims.i;
  std::vector<T> low_row(row), high_row(row);
  T *const low = low_row.data(), *const high = high_row.data();
  for (std::size_t z = 0; z < axes[2].code.size(); ++z) {
    throw_if_canceled();
    for (std::size_t y = 0; y < axes[1].code.size(); ++y) {
      const T* first = samples + volume_.index(0, axes[1].cut[y], axes[2].cut[z]);
      std::copy(first, first + row, low);
      std::copy(first, first + row, high);
      for (int k = axes[2].cut[z]; k <= axes[2].cut[z + 1]; ++k) {
        for (int j = axes[1].cut[y]; j <= axes[1].cut[y + 1]; ++j) {
          const T* s = samples + volume_.index(0, j, k);
          for (std::size_t i = 0; i < row; ++i) low[i] = s[i] < low[i] ? s[i] : low[i];
          for (std::size_t i = 0; i < row; ++i) high[i] = s[i] > high[i] ? s[i] : high[i];
        }
      }
      for (std::size_t x = 0; x < axes[0].code.size(); ++x) {
        const int begin = axes[0].cut[x], end = axes[0].cut[x + 1];
        MinMax<T> brick{low[begin], high[begin]};
        for (int i = begin + 1; i <= end; ++i) {
          brick = {std::min(brick.min, low[i]), std::max(brick.max, high[i])};
        }
        nodes[leaves | axes[0].code[x] | axes[1].code[y] | axes[2].code[z]] = brick;
      }
    }
  }
  for (std::size_t n = leaves - 1; n >= 1; --n) {
    nodes[n] = {std::min(nodes[2 * n].min, nodes[2 * n + 1].min),
                std::max(nodes[2 * n].max, nodes[2 * n + 1].max)};
  }
}

bool VoxelTree::active(double kappa) const {
  return std::visit(
      [&](const auto& nodes) {
        return static_cast<double>(nodes[1].min) < kappa &&
               static_cast<double>(nodes[1].max) >= kappa;
      },
      nodes_);
}

std::size_t VoxelTree::bytes() const {
  return std::visit([](const auto& nodes) { return nodes.size() * sizeof(nodes[0]); }, nodes_);
}

void VoxelTree::collect_voxels(const Segment& r, double kappa,
                               std::vector<VoxelSpan>& spans) const {
  spans.clear();
  if (!active(kappa)) return;
  const LatticeLine line = lattice_line(r.a, r.direction());
  const Range range = line.clip({0, 1});
  volume_.visit([&](const auto* samples) {
    using T = std::remove_cvref_t<decltype(*samples)>;
    find_along(line, range, samples, *inside_threshold<T>(kappa),
               [&](const VoxelSpan& span) { spans.push_back(span); });
  });
}

}  // namespace deliso
