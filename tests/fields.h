// SPDX-License-Identifier: MIT
// Small volumes for the tests of the stages, each with everything the stages ask of it.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "isosurface/isosurface.h"
#include "run/options.h"
#include "volume/sampled.h"
#include "volume/volume.h"

namespace deliso {

struct Scene {
  explicit Scene(Volume v, double isovalue)
      : volume(std::move(v)),
        surface(volume, geometric_isovalue(volume.type(), isovalue)),
        contour(build_contour(volume, surface.kappa())) {}
  Scene(const Scene&) = delete;

  Volume volume;
  Isosurface surface;
  ContourMesh contour;
};

// The criteria of the paper, but r over pole height: h/r and r/l, no bound on the distance.
inline Options paper_criteria() {
  Options options;
  options.limits[Criterion::h_over_r].value = 0.1;
  options.limits[Criterion::distance] = {Options::kNone, Length::Unit::world};
  options.r_min = {0.001, Length::Unit::box};
  return options;
}

inline Scene builtin_scene(const std::string& name, int size) {
  const std::string input = "builtin:" + name + ":" + std::to_string(size);
  return Scene(make_builtin_volume(input), find_builtin_field(input)->isovalue);
}
// A slab between two planes that are no faces of voxels.
inline Scene slab_scene() {
  return Scene(
      sampled<float>({12, 12, 12}, {1, 1, 1},
                     [](int i, int, int) { return 4 - std::abs(static_cast<float>(i) - 5.3f); }),
      0.7);
}

// Smooth noise: a few random waves, cut by the box.
inline Scene wave_scene(std::uint64_t seed, int size, Vec3 spacing = {1, 1, 1}) {
  Random random(seed);
  struct Wave {
    Vec3 k;
    double phase;
  };
  std::vector<Wave> waves;
  for (int w = 0; w < 6; ++w) {
    waves.push_back({{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                     random.uniform(0, 6)});
  }
  std::vector<float> samples;
  for_each_index({size, size, size}, [&](int i, int j, int k) {
    double sum = 0;
    for (const Wave& w : waves) {
      sum += std::sin(dot(w.k, Vec3{1.0 * i, 1.0 * j, 1.0 * k}) + w.phase);
    }
    samples.push_back(static_cast<float>(sum));
  });
  return Scene(Volume::from_samples({size, size, size}, spacing, samples), 0.3);
}

}  // namespace deliso
