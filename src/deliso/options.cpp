// SPDX-License-Identifier: MIT
#include "deliso/options.h"

#include <algorithm>

#include "base/check.h"
#include "base/text.h"

namespace deliso {
namespace {

// Triangles of a smaller circumradius, in voxels, are refined for nothing.
constexpr double kShapeFloor = 0.05;

double voxel_of(const Volume& volume) {
  const Vec3 s = volume.spacing();
  return std::min({s.x, s.y, s.z});
}

}  // namespace

double Length::in(const Volume& volume) const {
  switch (unit) {
    case Unit::box:
      return value * volume.box().smallest_side();
    case Unit::voxel:
      return value * voxel_of(volume);
    case Unit::world:
      break;
  }
  return value;
}

void require_limits(const Options& o, const Volume& volume) {
  const double r_min_voxels = o.r_min.in(volume) / voxel_of(volume);
  if (volume.box().smallest_side() > 0 && !(r_min_voxels >= kSmallestRMin)) {
    throw InputError(text("--rmin is ", r_min_voxels, " voxels, and must be at least ",
                          kSmallestRMin, ": at creases refinement would hardly end"));
  }
  if (!(o.lambda >= 1))
    throw InputError("--lambda must be at least 1, or refinement would not end");
  if (o.samples > kMostSamples) {
    throw InputError(text("--samples is ", o.samples, ", and must be at most ", kMostSamples));
  }
}

Options Options::paper() {
  Options options;
  options.recover = RecoverWay::paper;
  options.epsilon1 = 0.1;
  options.epsilon2 = 0.2;
  options.r_min = {0.001, Length::Unit::box};
  options.max_distance = {kNone, Length::Unit::world};
  return options;
}

Parameters resolve(const Options& o, const Volume& volume) {
  const double voxel = voxel_of(volume), r_min = o.r_min.in(volume);
  Parameters p{};
  p.voxel = voxel;
  p.r_min = r_min;
  p.fingers = o.fingers.in(volume);
  p.recovery = {o.epsilon, Options::kNone, o.lambda, Options::kNone, Options::kNone, r_min, r_min};
  p.refinement = {o.epsilon1,
                  o.epsilon2,
                  o.lambda,
                  o.max_distance.in(volume),
                  o.max_radius,
                  r_min,
                  std::min(r_min, kShapeFloor * voxel)};
  if (o.recover == RecoverWay::paper) {
    p.as_published = true;
    p.refinement.shape_floor = r_min;  // nothing smaller than r_min is refined at all
  }
  // Fingers would ask for more than so many vertices.
  if (o.target_vertices != Options{}.target_vertices) p.fingers = Options::kNone;
  p.pole_side = o.pole_side;
  p.threads = o.threads;
  p.seed = o.seed;
  p.samples = o.samples;
  p.min_component = o.min_component;
  p.target_vertices = o.target_vertices;
  p.max_vertices = o.max_vertices;
  p.keep_partial = o.keep_partial;
  p.progress = o.progress;
  p.profile = o.profile;
  p.trace = o.trace;
  return p;
}

}  // namespace deliso
