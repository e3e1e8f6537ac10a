// SPDX-License-Identifier: MIT
#include "io/filter/gaussian.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

template <class T>
Volume random_volume(Index3 dims, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> samples(static_cast<std::size_t>(dims.i) * static_cast<std::size_t>(dims.j) *
                         static_cast<std::size_t>(dims.k));
  const double least = std::is_signed_v<T> ? -100 : 0;
  for (T& s : samples) s = static_cast<T>(random.uniform(least, 127));
  return Volume::from_samples(dims, {1, 1, 1}, samples);
}

// The index of scipy's mode "reflect", by walking: at an end the same sample once more, then back.
int walked(int i, int n) {
  while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
  return i;
}

// The definition: a sum over the whole box of weights, each axis cut off at 4 sigma.
double oracle(const Volume& volume, Index3 at, const Vec3& sigma) {
  const Index3 n = volume.dims();
  Index3 r;
  for (int axis = 0; axis < 3; ++axis) r[axis] = static_cast<int>(4 * sigma[axis] + 0.5);
  const auto weight = [](int d, double s) { return d == 0 ? 1 : std::exp(-d * d / (2 * s * s)); };
  double sum = 0, weights = 0;
  for (int dk = -r.k; dk <= r.k; ++dk) {
    for (int dj = -r.j; dj <= r.j; ++dj) {
      for (int di = -r.i; di <= r.i; ++di) {
        const double w = weight(di, sigma.x) * weight(dj, sigma.y) * weight(dk, sigma.z);
        weights += w;
        sum += w * volume.sample(walked(at.i + di, n.i), walked(at.j + dj, n.j),
                                 walked(at.k + dk, n.k));
      }
    }
  }
  return sum / weights;
}

template <class T>
void hold_against_oracle(Index3 dims, const Vec3& sigma, SampleType type, double tolerance) {
  const Volume volume = random_volume<T>(dims, 7);
  const Volume smooth = gaussian(volume, sigma, 2);
  CHECK(smooth.type() == type);
  REQUIRE(smooth.dims() == dims);
  double most = 0;
  for_each_index(dims, [&](int i, int j, int k) {
    most = std::max(most, std::fabs(smooth.sample(i, j, k) - oracle(volume, {i, j, k}, sigma)));
  });
  CHECK(most < tolerance);
  CHECK(smooth.sample(1, 1, 1) != volume.sample(1, 1, 1));
}

}  // namespace

TEST_CASE("every sample is the sum over its box of weights, in all types") {
  const Index3 dims{11, 9, 7};
  const Vec3 sigma{1, 0.7, 0.5};
  hold_against_oracle<std::uint8_t>(dims, sigma, SampleType::f32, 1e-5);
  hold_against_oracle<std::int8_t>(dims, sigma, SampleType::f32, 1e-5);
  hold_against_oracle<std::uint16_t>(dims, sigma, SampleType::f32, 1e-5);
  hold_against_oracle<std::int16_t>(dims, sigma, SampleType::f32, 1e-5);
  hold_against_oracle<std::uint32_t>(dims, sigma, SampleType::f64, 1e-11);
  hold_against_oracle<std::int32_t>(dims, sigma, SampleType::f64, 1e-11);
  hold_against_oracle<float>(dims, sigma, SampleType::f32, 1e-5);
  hold_against_oracle<double>(dims, sigma, SampleType::f64, 1e-11);
}

TEST_CASE("a Gaussian wider than the box is reflected more than once") {
  hold_against_oracle<double>({4, 3, 2}, {2, 1.5, 3}, SampleType::f64, 1e-11);
}

TEST_CASE("an axis of less than an eighth of a sample is left alone") {
  CHECK(gaussian_radius(0.12) == 0);
  CHECK(gaussian_radius(0.13) == 1);
  CHECK(gaussian_radius(1) == 4);
  hold_against_oracle<double>({6, 5, 4}, {1, 0.1, 0}, SampleType::f64, 1e-11);
}

TEST_CASE("the same bytes with any number of threads, also in a volume of several tasks") {
  const Volume volume = random_volume<std::uint16_t>({13, 12, 37}, 3);
  const Volume one = gaussian(volume, {1.3, 1.3, 1.3}, 1);
  for (const int threads : {2, 3, 8}) {
    CHECK(same_samples(one, gaussian(volume, {1.3, 1.3, 1.3}, threads)));
  }
}

TEST_CASE("what is constant stays so, exactly, and the frame is kept") {
  Frame frame;
  frame.origin = {3, -4, 5};
  const Volume volume =
      Volume::from_samples({9, 9, 9}, {1, 2, 3}, std::vector<std::int16_t>(9 * 9 * 9, -777), frame);
  const Volume smooth = gaussian(volume, {2, 1, 0.7});
  CHECK(smooth.frame() == frame);
  CHECK(smooth.spacing() == Vec3{1, 2, 3});
  const ValueRange range = value_range(smooth);
  CHECK(range.min == -777);
  CHECK(range.max == -777);
}
