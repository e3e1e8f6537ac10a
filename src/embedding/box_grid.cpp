// SPDX-License-Identifier: MIT
#include "embedding/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.h"

namespace deliso {
namespace {

constexpr std::size_t kMinLists = 64;

// The box of an empty place.
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr BoxGrid::Box kNowhere{{kInfinity, kInfinity, kInfinity},
                                {-kInfinity, -kInfinity, -kInfinity}};

}  // namespace

BoxGrid::BoxGrid(const Box3& box, double cell) {
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  // Coordinates stay below 2^20 cells, and above one, so that truncation rounds down.
  const double side = std::max(cell, longest * 0x1p-20);
  per_cell_ = side > 0 ? 1 / side : 1;
  margin_ = static_cast<float>((longest * per_cell_ + 2) * 0x1p-22);
  origin_ = box.lo - Vec3{2 / per_cell_, 2 / per_cell_, 2 / per_cell_};
}

void BoxGrid::expect(std::size_t elements) {
  levels_[0].lists.resize(std::max(kMinLists, std::bit_ceil(elements / 2 + 1)));
  blocks_.reserve(elements);
  places_.reserve(elements);
}

BoxGrid::Box BoxGrid::box_of(std::span<const Vec3> points) const {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    double lo = points[0][a], hi = lo;
    for (const Vec3& p : points.subspan(1)) {
      lo = std::min(lo, p[a]);
      hi = std::max(hi, p[a]);
    }
    box.lo[axis] = static_cast<float>((lo - origin_[a]) * per_cell_);
    box.hi[axis] = static_cast<float>((hi - origin_[a]) * per_cell_);
  }
  return box;
}

BoxGrid::Box BoxGrid::box_of(const std::vector<Vec3>& points, const Triangle& t) const {
  const std::array<Vec3, 3> corners{points[t[0]], points[t[1]], points[t[2]]};
  return box_of(corners);
}

BoxGrid::Box BoxGrid::box_around(const Vec3& center, double radius) const {
  Box box;
  const float reach = static_cast<float>(radius * per_cell_) + 2 * margin_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const auto x = static_cast<float>((center[a] - origin_[a]) * per_cell_);
    // The grid has nothing outside its box.
    box.lo[axis] = std::clamp(x - reach, 1.0f, 0x1p21f);
    box.hi[axis] = std::clamp(x + reach, 1.0f, 0x1p21f);
  }
  return box;
}

float BoxGrid::extent(const Box& box) {
  return std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
}

BoxGrid::Place BoxGrid::place_of(const Box& box) {
  const float extent = BoxGrid::extent(box);
  int level = 0;
  while (extent * scale_of(level) > 1) ++level;
  const float scale = scale_of(level);
  const auto along = [&](std::size_t axis) {
    return static_cast<std::uint32_t>(box.lo[axis] * scale);
  };
  return {number_of(along(0), along(1), along(2)), level};
}

void BoxGrid::add(Id id, const Box& box) {
  if (id >= places_.size()) places_.resize(id + 1);
  DELISO_ASSERT(places_[id].level < 0);
  places_[id] = place_of(box);
  Level& level = levels_[places_[id].level];
  if (level.size >= 2 * level.lists.size()) grow(level);
  append(level.list(places_[id].number), id, box);
  ++level.size;
  level.extent = std::max(level.extent, extent(box) + margin_);
}

void BoxGrid::Block::put(std::size_t i, Id what, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis][i] = box.lo[axis];
    hi[axis][i] = box.hi[axis];
  }
  id[i] = what;
}

void BoxGrid::append(List& in, Id id, const Box& box) {
  if (in.size == in.room * kLanes) {  // move to a run twice as long
    const auto power = static_cast<std::size_t>(std::bit_width(in.room));
    DELISO_CHECK(power < free_.size());
    std::uint32_t to;
    if (free_[power].empty()) {
      to = static_cast<std::uint32_t>(blocks_.size());
      blocks_.resize(blocks_.size() + (std::size_t{1} << power));
    } else {
      to = free_[power].back();
      free_[power].pop_back();
    }
    std::copy_n(blocks_.begin() + in.first, in.room, blocks_.begin() + to);
    if (in.room > 0) free_[power - 1].push_back(in.first);
    in.first = to;
    in.room = std::uint32_t{1} << power;
  }
  Block& block = blocks_[in.first + in.size / kLanes];
  if (in.size % kLanes == 0) {
    for (std::size_t i = 0; i < kLanes; ++i) block.put(i, kNoElement, kNowhere);
  }
  block.put(in.size++ % kLanes, id, box);
}

void BoxGrid::remove(Id id) {
  Level& level = levels_[places_[id].level];
  List& in = level.list(places_[id].number);
  const auto block = [&](std::uint32_t n) -> Block& { return blocks_[in.first + n / kLanes]; };
  std::uint32_t n = 0;
  while (block(n).id[n % kLanes] != id) ++n;
  DELISO_ASSERT(n < in.size);
  const std::uint32_t last = --in.size;
  block(n).put(n % kLanes, block(last).id[last % kLanes], block(last).box(last % kLanes));
  block(last).put(last % kLanes, kNoElement, kNowhere);
  --level.size;
  places_[id] = {};
}

// Makes four times as many lists.
void BoxGrid::grow(Level& level) {
  const std::size_t size = std::max(kMinLists, 4 * level.lists.size());
  const std::vector<List> before = std::exchange(level.lists, std::vector<List>(size));
  for (const List& in : before) {
    for (std::uint32_t n = 0; n < in.size; ++n) {
      const Block block = blocks_[in.first + n / kLanes];
      const Id id = block.id[n % kLanes];
      append(level.list(places_[id].number), id, block.box(n % kLanes));
    }
    if (in.room > 0)
      free_[static_cast<std::size_t>(std::bit_width(in.room)) - 1].push_back(in.first);
  }
}

}  // namespace deliso
