// SPDX-License-Identifier: MIT
#include "more/bodies/partition.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deliso {
namespace {

constexpr double kOutside = -1e30;  // less than any field

}  // namespace

Partition::Partition(std::vector<BodyField> fields) : fields_(std::move(fields)) {
  for (const BodyField& field : fields_) {
    const Box3 box = field.volume.box();
    boxes_.push_back({box.lo + field.offset, box.hi + field.offset});
  }
}

double Partition::value(BodyId body, const Vec3& p) const {
  return boxes_[body].contains(p) ? fields_[body].value(p) : kOutside;
}

Partition::Ranking Partition::rank(const Vec3& p) const {
  Ranking best;
  for (BodyId body = 0; body < size(); ++body) {
    const double f = value(body, p);
    if (f == kOutside) continue;
    std::size_t place = best.count;
    while (place > 0 && best.value[place - 1] < f) --place;
    if (place == Ranking::kMost) continue;
    best.count = std::min(best.count + 1, Ranking::kMost);
    for (std::size_t n = best.count - 1; n > place; --n) {
      best.value[n] = best.value[n - 1];
      best.body[n] = best.body[n - 1];
    }
    best.value[place] = f;
    best.body[place] = body;
  }
  return best;
}

BodyId Partition::body_at(const Vec3& p) const {
  const Ranking best = rank(p);
  return best.count > 0 ? best.body[0] : 0;
}

std::optional<Vec3> Partition::tie(const Vec3& from, std::span<const BodyId> bodies,
                                   double within) const {
  constexpr int kMostSteps = 40;
  const double voxel = volume().voxel();
  Vec3 p = from;
  for (int n = 0; n < kMostSteps; ++n) {
    const double f = value(bodies[0], p);
    const Vec3 gradient = fields_[bodies[0]].gradient(p);
    // Gram-Schmidt over the gradients of the differences.
    std::array<Vec3, 3> axes;
    std::array<double, 3> along{};
    Vec3 step;
    for (std::size_t m = 1; m < bodies.size(); ++m) {
      Vec3 row = fields_[bodies[m]].gradient(p) - gradient;
      double wanted = f - value(bodies[m], p);
      for (std::size_t l = 1; l < m; ++l) {
        const double share = dot(row, axes[l - 1]);
        row = row - share * axes[l - 1];
        wanted -= share * along[l - 1];
      }
      const double norm = length(row);
      if (!(norm * voxel > 1e-6) || !(std::fabs(wanted) < 1e6)) return std::nullopt;
      axes[m - 1] = row / norm;
      along[m - 1] = wanted / norm;
      step = step + along[m - 1] * axes[m - 1];
    }
    const double size = length(step);
    if (size < 1e-6 * voxel) return p;
    p = p + std::min(1.0, 0.4 * voxel / size) * step;
    if (!(distance2(p, from) <= within * within)) return std::nullopt;
  }
  return std::nullopt;
}

double Partition::distance_to_tie(const Vec3& p, BodyId a, BodyId b) const {
  const double slope = length(fields_[a].gradient(p) - fields_[b].gradient(p));
  return std::fabs(value(a, p) - value(b, p)) / std::max(slope, 0.01 / volume().voxel());
}

}  // namespace deliso
