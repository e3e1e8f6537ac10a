// SPDX-License-Identifier: MIT
#include "run/options.h"

#include <algorithm>

#include "base/check.h"
#include "base/text.h"

namespace deliso {
namespace {

// Facets with a smaller circumradius are not refined, not even for shape.
constexpr double kShapeFloorVoxels = 0.05;

// The distance to which facets that face each other are moved apart, and the largest by which that
// moves a vertex off Sigma. Programs that fill surfaces with tetrahedra take facets much nearer
// than that for one.
constexpr double kGapVoxels = 8e-4;

}  // namespace

double Length::in(const Grid& volume) const {
  switch (unit) {
    case Unit::box:
      return value * volume.box().smallest_side();
    case Unit::voxel:
      return value * volume.voxel();
    case Unit::world:
      break;
  }
  return value;
}

void require_limits(const Options& o, const Grid& volume) {
  if (!(volume.box().smallest_side() > 0)) {
    throw InputError("a volume needs two or more samples along each axis");
  }
  const double r_min_voxels = o.r_min.in(volume) / volume.voxel();
  if (!(r_min_voxels >= kSmallestRMin)) {
    throw InputError("r_min (--rmin) is ", r_min_voxels, " voxels, and must be at least ",
                     kSmallestRMin, ": at creases refinement would hardly end");
  }
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const CriterionRow& row = kCriterionTable[n];
    if (!(o.limits.values[n].value >= row.least)) {
      throw InputError("the limit ", row.name, " must be at least ", row.least,
                       ", or refinement would not end");
    }
  }
}

PerCriterion<Length> Options::usual_limits() {
  PerCriterion<Length> limits;
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const CriterionRow& row = kCriterionTable[n];
    limits.values[n] = {row.usual, row.is_length ? Length::Unit::voxel : Length::Unit::world};
  }
  return limits;
}

Parameters resolve(const Options& o, const Grid& volume) {
  const double voxel = volume.voxel(), r_min = o.r_min.in(volume);
  Parameters p{};
  static_cast<RunSettings&>(p) = o;
  p.voxel = voxel;
  p.r_min = r_min;
  p.gap = kGapVoxels * volume.least_voxel();
  for (std::size_t n = 0; n < kCriteria; ++n) {
    p.refinement.limits.values[n] = o.limits.values[n].in(volume);
  }
  p.refinement.r_min = r_min;
  p.refinement.shape_floor = std::min(r_min, kShapeFloorVoxels * voxel);
  return p;
}

}  // namespace deliso
