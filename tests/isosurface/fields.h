// SPDX-License-Identifier: MIT
// Small volumes and hard segments for the tests of the kd-tree and the oracle.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/segment.h"
#include "volume/sampled.h"
#include "volume/volume.h"

namespace deliso {

struct TestField {
  std::string name;
  Volume volume;
  double kappa;
};

inline TestField test_field(std::string name, Volume volume, double kappa) {
  const double used = geometric_isovalue(volume.type(), kappa);
  return {std::move(name), std::move(volume), used};
}

// Returns places whose distances are up to seven times as large as others.
inline std::vector<double> uneven_places(int count, Random& random) {
  std::vector<double> places{0};
  while (places.size() < static_cast<std::size_t>(count)) {
    places.push_back(places.back() + std::exp(random.uniform(-1, 1)));
  }
  return places;
}

inline std::vector<TestField> test_fields() {
  std::vector<TestField> fields;
  Random random(7);
  fields.push_back(
      test_field("noise",
                 sampled<std::uint8_t>({12, 10, 11}, {1, 1, 1},
                                       [&](int, int, int) { return random.below(256); }),
                 128.5));
  fields.push_back(test_field("wave",
                              sampled<float>({14, 13, 11}, {0.7, 1.3, 0.31},
                                             [](int i, int j, int k) {
                                               return std::sin(0.9 * i) +
                                                      std::cos(0.8 * j) * std::sin(0.7 * k + 0.3);
                                             }),
                              0.1));
  // Plateaus at kappa itself, and samples that are mostly one value.
  fields.push_back(test_field(
      "plateaus",
      sampled<std::int16_t>({9, 16, 9}, {1, 1, 1},
                            [&](int, int, int) { return static_cast<int>(random.below(3)) - 1; }),
      0));
  fields.push_back(test_field("ball",
                              sampled<double>({17, 9, 9}, {0.5, 1, 1},
                                              [](int i, int j, int k) {
                                                return 4 - std::sqrt(0.25 * (i - 8) * (i - 8) +
                                                                     (j - 4) * (j - 4) +
                                                                     (k - 4) * (k - 4));
                                              }),
                              1.2));
  // Symmetric about lattice planes and halfway between integers: exact zeros at many points.
  fields.push_back(test_field(
      "checker",
      sampled<std::uint16_t>({8, 8, 12}, {1, 1, 3},
                             [](int i, int j, int k) { return (i / 2 + j / 2 + k / 3) % 2; }),
      0.5));
  // Lines of a hundred voxels and more.
  fields.push_back(test_field(
      "rod",
      sampled<std::uint8_t>({160, 3, 4}, {1, 2, 1}, [&](int, int, int) { return random.below(9); }),
      1.5));
  // Samples at places of their own, along two axes.
  const Volume even =
      sampled<std::uint8_t>({9, 8, 12}, {1, 2, 1}, [&](int, int, int) { return random.below(9); });
  fields.push_back(test_field(
      "uneven",
      even.with_places({{{}, {0, 1, 1.5, 4, 6, 6.25, 9, 12}, uneven_places(12, random)}}, "test"),
      3.5));
  return fields;
}

// A point of one of several kinds: inside, on lattice planes, edges or corners, around the box.
inline Vec3 hard_point(Random& random, const Volume& volume) {
  const Index3 n = volume.voxels();
  const std::uint32_t kind = random.below(8);
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    double u = random.uniform(0, n[axis]);
    if (kind >= 5 && random.below(2) == 0) u = std::round(u);
    if (kind == 4) u = random.uniform(-0.5 * n[axis], 1.5 * n[axis]);
    if (kind == 7) u = std::round(2 * u) / 2;
    p[axis] = volume.at_samples(u, axis);
  }
  return p;
}

inline Segment hard_segment(Random& random, const Volume& volume) {
  Segment r{hard_point(random, volume), hard_point(random, volume)};
  const std::uint32_t kind = random.below(16);
  if (kind < 3)  // parallel to an axis or a plane
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (axis != kind && random.below(3) > 0) r.b[axis] = r.a[axis];
  if (kind == 3) {  // along a diagonal of the lattice
    const double s = random.uniform(-4, 4);
    for (int axis = 0; axis < 3; ++axis)
      r.b[axis] = r.a[axis] + (random.below(2) ? s : -s) * volume.spacing()[axis];
  }
  if (kind == 4) {  // huge
    const Vec3 d = r.direction();
    r = {r.a - 1e6 * d, r.a + 1e7 * d};
  }
  if (kind == 5) r.b = r.a + 1e-3 * r.direction();
  if (kind == 6) r.b = r.a;
  if (kind == 7) r.b[static_cast<int>(random.below(3))] += 1e-14;
  return r;
}

}  // namespace deliso
