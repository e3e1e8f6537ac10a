// SPDX-License-Identifier: MIT
#include "more/bodies/partition.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace deliso {
namespace {

// The field of the body that a sample keeps is at least this many times the largest other.
constexpr float kAhead = 1.2F;
// How far the border at a face of the box lies within it, in samples: none of it lies beyond.
constexpr float kWithin = 1e-6F;

bool is_in(const Volume& block, Index3 sample) {
  for (int axis = 0; axis < 3; ++axis) {
    const int n = sample[axis] - block.first()[axis];
    if (n < 0 || n >= block.dims()[axis]) return false;
  }
  return true;
}

// The share of the Euler number of closed cubes that one of their corners has, in eighths: 8 for
// itself, 4 for an edge, 2 for a face, 1 for a cube. Bit m: cube m around the corner is there.
std::int64_t share_of_corner(unsigned cubes) {
  constexpr std::array<unsigned, 3> kLow{0x55, 0x33, 0x0f};  // the cubes below it along each axis
  int eighths = 8 - std::popcount(cubes);
  for (int axis = 0; axis < 3; ++axis) {
    eighths -= (cubes & kLow[axis]) != 0 ? 4 : 0;
    eighths -= (cubes & ~kLow[axis]) != 0 ? 4 : 0;
    eighths += 2 * std::popcount((cubes | cubes >> (1 << axis)) & kLow[axis]);
  }
  return eighths;
}

}  // namespace

Partition::Partition(const Grid& shape, std::vector<Volume> fields, BodyId background, int threads,
                     std::vector<BodyId> kept)
    : shape_(shape), fields_(std::move(fields)), background_(background), body_(std::move(kept)) {
  if (!body_.empty()) {
    raise_fields(threads);
    return;
  }
  body_.resize(shape.sample_count());
  const Index3 n = shape.dims();
  for_each_task(threads, static_cast<std::size_t>(n.k), [&](std::size_t slice) {
    std::vector<float> most(static_cast<std::size_t>(n.i) * static_cast<std::size_t>(n.j), 0);
    for_each_value(static_cast<int>(slice),
                   [&](BodyId body, std::size_t at, std::size_t in_slice, float value) {
                     if (value > most[in_slice]) {
                       most[in_slice] = value;
                       body_[at] = body;
                     }
                   });
  });
}

// Calls visit(body, sample's number, that in its slice, value) for all bodies whose blocks have
// samples in slice k, in the order of the bodies.
template <class Visit>
void Partition::for_each_value(int k, Visit&& visit) const {
  for (BodyId body = 0; body < size(); ++body) {
    const Volume& f = fields_[body];
    const Index3 first = f.first(), dims = f.dims();
    if (k < first.k || k >= first.k + dims.k) continue;
    f.visit([&](const auto* values) {
      for (int j = 0; j < dims.j; ++j) {
        const auto* row = values + f.index(0, j, k - first.k);
        const std::size_t at = shape_.index(first.i, first.j + j, k),
                          in_slice = shape_.index(first.i, first.j + j, 0);
        for (int i = 0; i < dims.i; ++i) {
          visit(body, at + static_cast<std::size_t>(i), in_slice + static_cast<std::size_t>(i),
                static_cast<float>(row[i]));
        }
      }
    });
  }
}

// Raises the field of each sample's body there.
void Partition::raise_fields(int threads) {
  struct Raised {
    std::size_t sample;
    float value;
  };
  const Index3 n = shape_.dims();
  std::vector<std::vector<Raised>> of_slice(static_cast<std::size_t>(n.k));
  for_each_task(threads, of_slice.size(), [&](std::size_t slice) {
    const std::size_t samples = static_cast<std::size_t>(n.i) * static_cast<std::size_t>(n.j);
    std::vector<float> own(samples, 0), others(samples, 0);
    for_each_value(static_cast<int>(slice),
                   [&](BodyId body, std::size_t at, std::size_t in_slice, float value) {
                     float& most = body == body_[at] ? own[in_slice] : others[in_slice];
                     most = std::max(most, value);
                   });
    for (std::size_t at = 0; at < samples; ++at) {
      if (own[at] < kAhead * others[at]) {
        of_slice[slice].push_back({slice * samples + at, kAhead * others[at]});
      }
    }
  });
  std::vector<std::vector<Raised>> of_body(size());
  for (const std::vector<Raised>& raised : of_slice) {
    for (const Raised& r : raised) of_body[body_[r.sample]].push_back(r);
  }
  for_each_task(threads, size(), [&](std::size_t body) {
    if (of_body[body].empty()) return;
    Volume& f = fields_[body];
    std::vector<float> values;
    f.visit([&](const auto* from) { values.assign(from, from + f.sample_count()); });
    for (const Raised& r : of_body[body]) {
      const auto at = static_cast<int>(r.sample % static_cast<std::size_t>(n.i)),
                 row = static_cast<int>(r.sample / static_cast<std::size_t>(n.i));
      values[f.index(at - f.first().i, row % n.j - f.first().j, row / n.j - f.first().k)] = r.value;
    }
    f = Volume::from_samples(f, values);
  });
}

std::array<BodyId, 2> Partition::in_order(BodyId a, BodyId b) const {
  if (is_beyond(a) || is_beyond(b)) return {std::max(a, b), std::min(a, b)};
  if (a == background_ || b == background_) return {background_, a == background_ ? b : a};
  return {std::max(a, b), std::min(a, b)};
}

double Partition::value(BodyId body, Index3 sample) const {
  const Volume& f = fields_[body];
  if (!is_in(f, sample)) return 0;
  const Index3 first = f.first();
  return f.sample(sample.i - first.i, sample.j - first.j, sample.k - first.k);
}

double Partition::value(BodyId body, const Vec3& p) const {
  return fields_[body].box().contains(p) ? fields_[body].value(p) : 0;
}

Vec3 Partition::gradient(BodyId body, const Vec3& p) const {
  return fields_[body].box().contains(p) ? fields_[body].gradient(p) : Vec3();
}

std::vector<std::uint64_t> Partition::samples() const {
  std::vector<std::uint64_t> count(size());
  for (const BodyId body : body_) ++count[body];
  return count;
}

std::vector<std::int64_t> Partition::euler_numbers() const {
  std::vector<std::int64_t> eighths(size());
  const Index3 n = shape_.dims();
  for_each_place({}, n, [&](Index3 corner) {
    std::array<BodyId, 8> around;
    for (int m = 0; m < 8; ++m) {
      const Index3 at = corner + Index3{-(~m & 1), -(~m >> 1 & 1), -(~m >> 2 & 1)};
      const bool is_there =
          std::min({at.i, at.j, at.k}) >= 0 && at.i < n.i && at.j < n.j && at.k < n.k;
      around[m] = is_there ? body_at(at) : kNoId;
    }
    for (int m = 0; m < 8; ++m) {
      unsigned cubes = 0;
      for (int o = 0; o < 8; ++o) cubes |= unsigned{around[o] == around[m]} << o;
      const bool is_first = std::countr_zero(cubes) == m;
      if (around[m] != kNoId && is_first) eighths[around[m]] += share_of_corner(cubes);
    }
  });
  for (std::int64_t& euler : eighths) euler /= 4;  // of the surface: twice that of the cubes
  return eighths;
}

Volume Partition::difference(std::array<BodyId, 2> bodies, const SampleBox& box) const {
  const BodyId in_front = bodies[0], behind = bodies[1];
  std::vector<float> samples;
  if (is_beyond(in_front)) {  // the voxels at the face
    const int axis = static_cast<int>(in_front - size()) / 2;
    const bool is_high = (in_front - size()) % 2 != 0;
    Index3 first;
    if (is_high) first[axis] = shape_.dims()[axis] - 2;
    for (unsigned m = 0; m < 8; ++m) {
      samples.push_back(((m >> axis & 1) != 0) == is_high ? -kWithin : 1 - kWithin);
    }
    return Volume::from_samples(shape_.part(first, {2, 2, 2}), samples);
  }
  const Grid block = shape_.part(box.begin, box.dims());
  samples.resize(block.sample_count());
  for (const float sign : {1.0F, -1.0F}) {
    const Volume& f = fields_[sign > 0 ? behind : in_front];
    const Index3 first = f.first(), end = first + f.dims();
    Index3 lo, hi;  // of the samples in both
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::max(box.begin[axis], first[axis]);
      hi[axis] = std::min(box.end[axis], end[axis] - 1);
    }
    f.visit([&](const auto* values) {
      for_each_place(lo, hi, [&](Index3 at) {
        const std::size_t to = block.index(at.i - box.begin.i, at.j - box.begin.j,
                                           at.k - box.begin.k),
                          from = f.index(at.i - first.i, at.j - first.j, at.k - first.k);
        samples[to] += sign * static_cast<float>(values[from]);
      });
    });
  }
  return Volume::from_samples(block, samples);
}

std::optional<Vec3> Partition::step_to_tie(const Vec3& p, std::span<const BodyId> bodies,
                                           unsigned faces) const {
  const double voxel = shape_.voxel(), f = value(bodies[0], p);
  const Vec3 gradient = this->gradient(bodies[0], p);
  const auto flat = [&](Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((faces >> (2 * axis) & 3) != 0) v[axis] = 0;
    }
    return v;
  };
  // Gram-Schmidt over the gradients of the differences.
  std::array<Vec3, 3> axes;
  std::array<double, 3> along{};
  Vec3 step;
  for (std::size_t m = 1; m < bodies.size(); ++m) {
    Vec3 row = flat(this->gradient(bodies[m], p) - gradient);
    double wanted = f - value(bodies[m], p);
    for (std::size_t l = 1; l < m; ++l) {
      const double share = dot(row, axes[l - 1]);
      row = row - share * axes[l - 1];
      wanted -= share * along[l - 1];
    }
    const double norm = length(row);
    if (!(norm * voxel > 1e-6)) return std::nullopt;
    axes[m - 1] = row / norm;
    along[m - 1] = wanted / norm;
    step = step + along[m - 1] * axes[m - 1];
  }
  return step;
}

}  // namespace deliso
