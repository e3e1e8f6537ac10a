// SPDX-License-Identifier: MIT
// Random segmentations against gray images. (The sizes of labels are the limits of the header.)
#include "io/filter/looks_like_labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"
#include "io/volume/builtin_fields.h"
#include "io/volume/builtin_volume.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

constexpr int kLabelSide = 32;

template <class T, class F>
Volume made(int side, F value) {
  return sampled<T>({side, side, side}, {1, 1, 1}, [&](int i, int j, int k) {
    return value(Vec3{double(i), double(j), double(k)});
  });
}

std::vector<Vec3> random_points(Random& random, int count) {
  std::vector<Vec3> points(static_cast<std::size_t>(count));
  for (Vec3& p : points) {
    p = {random.uniform(0, kLabelSide), random.uniform(0, kLabelSide),
         random.uniform(0, kLabelSide)};
  }
  return points;
}

// Balls on a background of 0; `label(n)` is the label of ball n.
template <class T, class F>
Volume balls(std::uint64_t seed, int count, double least, double most, F label) {
  Random random(seed);
  const std::vector<Vec3> centers = random_points(random, count);
  std::vector<double> radii;
  for (int n = 0; n < count; ++n) radii.push_back(random.uniform(least, most));
  return made<T>(kLabelSide, [&](const Vec3& p) {
    for (std::size_t n = 0; n < centers.size(); ++n) {
      if (distance(p, centers[n]) < radii[n]) return label(static_cast<int>(n));
    }
    return 0;
  });
}

Volume voronoi(std::uint64_t seed, std::uint32_t cells, std::uint32_t labels) {
  Random random(seed);
  const std::vector<Vec3> sites = random_points(random, static_cast<int>(cells));
  std::vector<std::uint32_t> label_of;
  for (std::uint32_t n = 0; n < cells; ++n) label_of.push_back(labels > 0 ? n % labels : n);
  return made<std::uint16_t>(kLabelSide, [&](const Vec3& p) {
    std::size_t nearest = 0;
    for (std::size_t n = 0; n < sites.size(); ++n) {
      if (distance2(p, sites[n]) < distance2(p, sites[nearest])) nearest = n;
    }
    return label_of[nearest];
  });
}

// Noise of mean 0 and deviation 1, smoothed by `sigma`.
Volume smooth_noise(std::uint64_t seed, double sigma) {
  Random random(seed);
  const Volume noise = made<float>(kLabelSide, [&](const Vec3&) { return random.uniform(-1, 1); });
  const Volume smooth = sigma > 0 ? gaussian(noise, {sigma, sigma, sigma}) : noise;
  double sum = 0;
  smooth.visit([&](const auto* s) {
    for (std::size_t n = 0; n < smooth.sample_count(); ++n) sum += s[n] * s[n];
  });
  const double deviation = std::sqrt(sum / static_cast<double>(smooth.sample_count()));
  return made<float>(kLabelSide, [&](const Vec3& p) {
    return smooth.sample(int(p.x), int(p.y), int(p.z)) / deviation;
  });
}

// `level(g)` of each sample of smooth noise, as T.
template <class T, class F>
Volume levels(std::uint64_t seed, double sigma, F level) {
  const Volume g = smooth_noise(seed, sigma);
  return made<T>(kLabelSide,
                 [&](const Vec3& p) { return level(g.sample(int(p.x), int(p.y), int(p.z))); });
}

}  // namespace

TEST_CASE("random segmentations look like labels, of every type") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    for (const auto& [number, least, most] :
         {std::tuple{1, 10.0, 10.0}, {10, 2.0, 5.0}, {20, 1.0, 3.0}, {60, 1.5, 2.5}}) {
      const int count = number;
      CAPTURE(count);
      CHECK(
          looks_like_labels(balls<std::uint8_t>(seed, count, least, most, [](int) { return 1; })));
      CHECK(looks_like_labels(
          balls<std::uint8_t>(seed, count, least, most, [](int) { return 255; })));
      CHECK(looks_like_labels(
          balls<std::int32_t>(seed, count, least, most, [](int n) { return 7 * n - 90; })));
      CHECK(looks_like_labels(balls<float>(seed, count, least, most, [](int n) { return n + 1; })));
    }
    for (const std::uint32_t cells : {2u, 20u, 300u}) {
      CAPTURE(cells);
      CHECK(looks_like_labels(voronoi(seed, cells, 0)));
      CHECK(looks_like_labels(voronoi(seed, cells, 4)));
    }
    for (const double sigma : {0.7, 1.0, 2.0, 4.0}) {
      CAPTURE(sigma);
      CHECK(looks_like_labels(
          levels<std::uint8_t>(seed, sigma, [](double g) { return g > 0 ? 255 : 0; })));
      CHECK(looks_like_labels(levels<std::uint8_t>(seed, sigma, [](double g) { return g > 1.5; })));
    }
    CHECK(looks_like_labels(
        levels<std::int8_t>(seed, 2, [](double g) { return (g > 0) + (g > 1); })));
  }
  // Few rows of a large volume are looked at.
  CHECK(looks_like_labels(made<std::uint8_t>(170, [](const Vec3& p) {
    return distance(p, {80, 80, 80}) < 30 ? 3 : 0;
  })));
}

TEST_CASE("labels numbered in order of place are labels, on a background") {
  // Neighboring tissues differ by 1, as the values of a smooth image do.
  for (const int thick : {2, 3, 5}) {
    CAPTURE(thick);
    CHECK(looks_like_labels(
        sampled<std::uint8_t>({30 * thick, 40, 40}, {1, 1, 1}, [&](int i, int j, int k) {
          return 5 <= std::min(j, k) && std::max(j, k) < 35 ? i / thick + 1 : 0;
        })));
  }
}

TEST_CASE("a few samples of labels in a background are labels") {
  CHECK(looks_like_labels(sampled<std::uint8_t>({13, 11, 11}, {1, 1, 1}, [](int i, int j, int k) {
    return i % 6 == 3 && j % 6 == 3 && k % 6 == 3 ? 1 + i / 6 : 0;
  })));
}

TEST_CASE("gray images do not, of 8 bits neither") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    for (const double sigma : {0.0, 0.7, 1.0, 2.0, 4.0}) {
      CAPTURE(sigma);
      const auto byte = [](double g) { return std::clamp(128 + 40 * g, 0.0, 255.0); };
      const Volume gray = levels<std::uint8_t>(seed, sigma, byte);
      CHECK_FALSE(looks_like_labels(gray));
      CHECK_FALSE(looks_like_labels(median(gray, 1)));
      CHECK_FALSE(looks_like_labels(smooth_noise(seed, sigma)));
      // A dark background, which is flat.
      const auto dark = [](double g) { return std::clamp(100 * (g - 1), 0.0, 255.0); };
      CHECK_FALSE(looks_like_labels(levels<std::uint8_t>(seed, sigma, dark)));
      CHECK_FALSE(
          looks_like_labels(levels<std::int16_t>(seed, sigma, [](double g) { return 500 * g; })));
    }
  }
  for (const BuiltinField& field : builtin_fields()) {
    CAPTURE(field.name);
    CHECK_FALSE(looks_like_labels(make_builtin_volume("builtin:" + std::string(field.name))));
  }
  // Flat, but without edges.
  for (const double scale : {0.5, 0.8, 1.0}) {
    CHECK_FALSE(looks_like_labels(
        made<std::uint8_t>(64, [&](const Vec3& p) { return scale * length(p); })));
  }
  CHECK_FALSE(looks_like_labels(made<std::uint8_t>(8, [](const Vec3&) { return 3; })));
  CHECK_FALSE(looks_like_labels(made<double>(8, [](const Vec3& p) { return p.x < 4 ? 0 : 0.5; })));
  CHECK_FALSE(
      looks_like_labels(made<double>(8, [](const Vec3& p) { return p.x < 4 ? 0 : 1e300; })));
}
