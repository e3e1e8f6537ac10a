// SPDX-License-Identifier: MIT
// The volumes of the storm of options: those of tiny_volume.h, and kinds that options are about,
// with several components, labels or wide sheets. 2 to 24 samples along each axis unless more are
// asked for, spacings up to 0.3:20:20. A seed says everything.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "stress/tiny_volume.h"
#include "volume/volume.h"

namespace deliso::stress {

struct OptionVolume {
  std::string_view kind;
  TinyVolume tiny;
  std::uint32_t labels = 0;   // it is a segmentation with labels 1 .. labels, 0 around them
  Coordinates coordinates{};  // for --coordinates: of one axis or more
};

namespace tiny {

struct Ball {
  Vec3 center;
  double radius;
};

inline std::vector<Ball> balls_in(Index3 dims, std::uint32_t count, Random& random) {
  const int least = std::min({dims.i, dims.j, dims.k});
  std::vector<Ball> balls(count);
  for (Ball& ball : balls) {
    for (int axis = 0; axis < 3; ++axis) ball.center[axis] = random.uniform(0, dims[axis] - 1);
    ball.radius = random.uniform(0.6, 0.2 * least + 1.2);
  }
  return balls;
}

// Returns the distance from a ball, in radii.
inline double radii_from(const Ball& ball, int i, int j, int k) {
  const Vec3 d = Vec3{1.0 * i, 1.0 * j, 1.0 * k} - ball.center;
  return std::sqrt(dot(d, d)) / ball.radius;
}

// Components of different sizes, some of which touch.
inline void blobs(Recipe& r, Random& random, std::uint32_t count) {
  const std::vector<Ball> balls = balls_in(r.dims, count, random);
  const std::uint32_t jitter = random.below(2) * random.below(30);
  fill(r, [&](int i, int j, int k) {
    double near = 4;
    for (const Ball& ball : balls) near = std::min(near, radii_from(ball, i, j, k));
    return std::floor(200 - 50 * near) + random.below(jitter + 1);
  });
  r.isovalue = 150 + random.uniform(0, 20);
}

// A segmentation: each sample has the label of the ball that it is deepest in.
inline void labels(Recipe& r, Random& random, std::uint32_t count) {
  const std::vector<Ball> balls = balls_in(r.dims, 3 * count, random);
  fill(r, [&](int i, int j, int k) {
    double near = 1.3;
    std::uint32_t label = 0;
    for (std::uint32_t n = 0; n < balls.size(); ++n) {
      const double radii = radii_from(balls[n], i, j, k);
      if (radii < near) label = n % count + 1;
      near = std::min(near, radii);
    }
    return label;
  });
  r.isovalue = 0.5;
}

// One connected sheet with many handles, which ends on the box.
inline void gyroid(Recipe& r, Random& random) {
  const double turn = random.uniform(0.3, 1.2), phase = random.uniform(0, 6.3);
  r.real = true;
  fill(r, [&](int i, int j, int k) {
    const double x = turn * i + phase, y = turn * j, z = turn * k;
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  });
  r.isovalue = random.uniform(-1, 1);
}

}  // namespace tiny

inline OptionVolume make_option_volume(std::uint64_t seed, std::uint32_t least = 2) {
  Random random(seed * 7919);
  tiny::Recipe r;
  constexpr std::uint32_t kMost[] = {6, 6, 9, 12, 12, 16, 20, 24};
  const std::uint32_t most = std::max(kMost[random.below(8)], least + 1);
  for (int axis = 0; axis < 3; ++axis) {
    r.dims[axis] = static_cast<int>(least + random.below(most + 1 - least));
  }
  constexpr std::uint64_t kKinds = kTinyKinds + 4;
  const std::uint64_t n = seed % kKinds;
  const std::uint32_t labels = n == kTinyKinds + 2 ? 1 + random.below(4) : 0;
  constexpr std::string_view kNames[] = {"blobs", "two-blobs", "labels", "gyroid"};
  if (n < kTinyKinds) {
    tiny::make(r, static_cast<TinyKind>(n), random);
  } else if (n == kTinyKinds) {
    tiny::blobs(r, random, 2 + random.below(8));
  } else if (n == kTinyKinds + 1) {
    tiny::blobs(r, random, 2);
  } else if (labels > 0) {
    tiny::labels(r, random, labels);
  } else {
    tiny::gyroid(r, random);
  }
  constexpr double kLengths[] = {1, 1, 2.5, 7, 20, 0.3};
  if (n >= kTinyKinds && random.below(3) == 0) {
    for (int axis = 0; axis < 3; ++axis) r.spacing[axis] = kLengths[random.below(6)];
  }
  const std::string_view kind =
      n < kTinyKinds ? name_of(static_cast<TinyKind>(n)) : kNames[n - kTinyKinds];
  OptionVolume volume{kind, tiny::of_some_type(r, random), labels};
  for (const int first = static_cast<int>(random.below(3)); const int axis : {0, 1, 2}) {
    if (axis != first && random.below(2) > 0) continue;
    std::vector<double>& at = volume.coordinates[static_cast<std::size_t>(axis)];
    at = {random.uniform(-9, 9)};
    while (at.size() < static_cast<std::size_t>(r.dims[axis])) {
      at.push_back(at.back() + r.spacing[axis] * std::exp(random.uniform(-0.7, 0.7)));
    }
  }
  return volume;
}

// As files that the program reads: the samples, and beside them their coordinates.
inline void write_files(const OptionVolume& volume, const std::string& path) {
  write_nrrd(volume.tiny.volume, path);
  std::ofstream out(path + ".xyz");
  out.precision(17);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (volume.coordinates[axis].empty()) continue;
    out << "xyz"[axis];
    for (const double at : volume.coordinates[axis]) out << ' ' << at;
    out << '\n';
  }
}

}  // namespace deliso::stress
