// SPDX-License-Identifier: MIT
#include "volume/volume.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

template <class T>
std::vector<T> random_samples(Random& random, std::size_t count) {
  std::vector<T> samples(count);
  for (T& v : samples) {
    if constexpr (std::is_floating_point_v<T>)
      v = static_cast<T>(random.uniform(-1000, 1000));
    else
      v = static_cast<T>(random.next());
  }
  return samples;
}

// The interpolant as the sum of the samples times their weights (1 - |x - i|)(1 - |y - j|)(...).
double weighted_sum(const Volume& volume, const Vec3& p) {
  double sum = 0;
  for (int k = 0; k < volume.dims().k; ++k) {
    for (int j = 0; j < volume.dims().j; ++j) {
      for (int i = 0; i < volume.dims().i; ++i) {
        const Vec3 at = volume.position({i, j, k});
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
          weight *= std::max(0.0, 1 - std::abs(p[axis] - at[axis]) / volume.spacing()[axis]);
        sum += weight * volume.sample(i, j, k);
      }
    }
  }
  return sum;
}

Vec3 random_point(const Volume& volume, Random& random) {
  const Vec3 top = volume.box().hi;
  return {random.uniform(0, top.x), random.uniform(0, top.y), random.uniform(0, top.z)};
}

template <class T>
void check_interpolation(std::uint64_t seed) {
  Random random(seed);
  const Index3 dims{2 + static_cast<int>(random.below(5)), 2 + static_cast<int>(random.below(5)),
                    2 + static_cast<int>(random.below(5))};
  const Vec3 spacing{random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3)};
  const std::size_t count = static_cast<std::size_t>(dims.i * dims.j * dims.k);
  const std::vector<T> samples = random_samples<T>(random, count);
  const Volume volume = Volume::from_samples(dims, spacing, samples);
  const ValueRange range = value_range(volume);
  const double scale = std::max({1.0, std::abs(range.min), std::abs(range.max)});
  CAPTURE(seed);
  for (int n = 0; n < 40; ++n) {
    const Vec3 p = random_point(volume, random);
    REQUIRE(std::abs(volume.value(p) - weighted_sum(volume, p)) <= 1e-13 * scale);
    // Along an axis g is linear within a voxel, so a difference within it is the derivative.
    const Vec3 gradient = volume.gradient(p);
    const Index3 voxel = volume.voxel_at(p);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 lo = p, hi = p;
      lo[axis] = voxel[axis] * spacing[axis];
      hi[axis] = (voxel[axis] + 1) * spacing[axis];
      const double slope = (weighted_sum(volume, hi) - weighted_sum(volume, lo)) / spacing[axis];
      REQUIRE(std::abs(gradient[axis] - slope) <= 1e-12 * scale / spacing[axis]);
    }
  }
  // At samples the interpolant is the sample, and outside the box it is that of the nearest point.
  for (int k = 0; k < dims.k; ++k)
    for (int j = 0; j < dims.j; ++j)
      for (int i = 0; i < dims.i; ++i)
        REQUIRE(std::abs(volume.value(volume.position({i, j, k})) - volume.sample(i, j, k)) <=
                1e-13 * scale);
  const Vec3 top = volume.box().hi;
  for (int n = 0; n < 20; ++n) {
    const Vec3 p{random.uniform(-5, 20), random.uniform(-5, 20), random.uniform(-5, 20)};
    const Vec3 inside{std::clamp(p.x, 0.0, top.x), std::clamp(p.y, 0.0, top.y),
                      std::clamp(p.z, 0.0, top.z)};
    REQUIRE(std::abs(volume.value(p) - weighted_sum(volume, inside)) <= 1e-13 * scale);
  }
}

// Checks effective_isovalue against its comment, sample by sample.
template <class T>
void check_isovalue(const Volume& volume, const std::vector<T>& samples, double kappa) {
  double below = -std::numeric_limits<double>::infinity(), least_inside = -below;
  bool equal = false;
  for (T s : samples) {
    const double v = static_cast<double>(s);
    equal |= v == kappa;
    if (v < kappa) below = std::max(below, v);
    if (v >= kappa) least_inside = std::min(least_inside, v);
  }
  const double lowered = effective_isovalue(volume, kappa);
  CAPTURE(kappa);
  if (!equal || std::isinf(below)) {
    CHECK(lowered == kappa);
    return;
  }
  const ValueRange range = value_range(volume);
  const double room = std::nextafter(kappa, below);
  if (room == below) {  // no number lies between
    CHECK(lowered == kappa);
    return;
  }
  // The same samples are inside, none is hit, and the level moved by 1e-9 of the range or to the
  // next number.
  CHECK(lowered < kappa);
  CHECK(lowered > below);
  CHECK(kappa - lowered <= std::max(1.001e-9 * (range.max - range.min), kappa - room));
}

template <class T>
void check_range_and_isovalues(std::uint64_t seed, std::size_t count, std::uint32_t values) {
  Random random(seed);
  std::vector<T> samples = random_samples<T>(random, count);
  if (values > 0)  // few different values: plateaus
    for (T& s : samples) s = static_cast<T>(random.below(values));
  const Volume volume = Volume::from_samples({static_cast<int>(count), 1, 1}, {1, 1, 1}, samples);
  const ValueRange range = value_range(volume);
  CAPTURE(seed);
  CHECK(range.min == static_cast<double>(*std::min_element(samples.begin(), samples.end())));
  CHECK(range.max == static_cast<double>(*std::max_element(samples.begin(), samples.end())));
  for (int n = 0; n < 6; ++n) {
    const double sample =
        static_cast<double>(samples[random.below(static_cast<std::uint32_t>(count))]);
    for (double kappa : {sample, sample + 0.25, sample + 1, std::nextafter(sample, 1e300)})
      check_isovalue(volume, samples, kappa);
  }
  for (double kappa : {range.min, range.max, range.min - 1, range.max + 1, 1e300, -1e300})
    check_isovalue(volume, samples, kappa);
}

template <class T>
void check_bad_sample(T bad, const char* word) {
  for (int n : {0, 1, 5, 59, 4095, 4096, 8191, 9999}) {
    std::vector<T> samples(10000, T{3});
    samples[static_cast<std::size_t>(n)] = bad;
    samples[9999] = bad;
    const Volume volume = Volume::from_samples({10, 20, 50}, {1, 1, 1}, samples);
    const std::string expected = std::string("v.nrrd: ") + word + " sample at (" +
                                 std::to_string(n % 10) + ", " + std::to_string(n / 10 % 20) +
                                 ", " + std::to_string(n / 200) + ")";
    CHECK_THROWS_WITH_AS(value_range(volume, "v.nrrd"), expected.c_str(), InputError);
  }
}

}  // namespace

TEST_CASE("the unit of lengths in voxels is the side of a cube with a voxel's volume") {
  const auto unit = [](Vec3 spacing) {
    return Volume::from_samples<float>({1, 1, 1}, spacing, {0}).voxel();
  };
  CHECK(unit({0.7, 0.7, 0.7}) == 0.7);
  CHECK(unit({0.25, 0.5, 1}) == 0.5);
  Random random(24);
  for (int n = 0; n < 1000; ++n) {
    const auto side = [&] { return std::exp2(20 * random.uniform() - 10); };
    const Vec3 s{side(), side(), side()};
    CAPTURE(n);
    CHECK(unit(s) ==
          doctest::Approx(std::cbrt(s.x) * std::cbrt(s.y) * std::cbrt(s.z)).epsilon(1e-12));
  }
}

TEST_CASE("value and gradient are those of the weighted sum of all samples") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    check_interpolation<std::uint8_t>(seed);
    check_interpolation<std::int8_t>(seed);
    check_interpolation<std::uint16_t>(seed);
    check_interpolation<std::int16_t>(seed);
    check_interpolation<std::uint32_t>(seed);
    check_interpolation<std::int32_t>(seed);
    check_interpolation<float>(seed);
    check_interpolation<double>(seed);
  }
}

TEST_CASE("corner m of a voxel is a sample; voxel_at is clamped to the box") {
  std::vector<std::uint16_t> samples(3 * 4 * 5);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = static_cast<std::uint16_t>(n);
  const Volume volume = Volume::from_samples({3, 4, 5}, {0.5, 2, 4}, samples);
  CHECK(volume.voxels() == Index3{2, 3, 4});
  CHECK(volume.box().hi == Vec3{1, 6, 16});
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i)
        for (int m = 0; m < 8; ++m)
          CHECK(volume.corners({i, j, k})[static_cast<std::size_t>(m)] ==
                volume.sample(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2)));
  CHECK(volume.voxel_at({-1, -1, -1}) == Index3{0, 0, 0});
  CHECK(volume.voxel_at({0.5, 2, 4}) == Index3{1, 1, 1});
  CHECK(volume.voxel_at({1, 6, 16}) == Index3{1, 2, 3});
  CHECK(volume.voxel_at({1e300, 1e300, 1e300}) == Index3{1, 2, 3});
}

TEST_CASE("range and effective isovalue of any number of samples, with or without plateaus") {
  std::uint64_t seed = 0;
  for (std::size_t count : {1u, 2u, 7u, 63u, 64u, 65u, 1000u, 4096u, 4097u, 20000u}) {
    for (std::uint32_t values : {0u, 1u, 2u, 5u, 100u}) {
      check_range_and_isovalues<std::uint8_t>(seed++, count, values);
      check_range_and_isovalues<std::int8_t>(seed++, count, values);
      check_range_and_isovalues<std::uint16_t>(seed++, count, values);
      check_range_and_isovalues<std::int16_t>(seed++, count, values);
      check_range_and_isovalues<std::uint32_t>(seed++, count, values);
      check_range_and_isovalues<std::int32_t>(seed++, count, values);
      check_range_and_isovalues<float>(seed++, count, values);
      check_range_and_isovalues<double>(seed++, count, values);
    }
  }
}

TEST_CASE("effective isovalue at the limits of the types") {
  const auto effective = []<class T>(std::vector<T> samples, double kappa) {
    const Volume volume =
        Volume::from_samples({static_cast<int>(samples.size()), 1, 1}, {1, 1, 1}, samples);
    check_isovalue(volume, samples, kappa);
    return effective_isovalue(volume, kappa);
  };
  CHECK(effective(std::vector<std::uint8_t>{0, 255, 7}, 255) == 255 - 1e-9 * 255);
  CHECK(effective(std::vector<std::uint8_t>{0, 255, 7}, 256) == 256);
  CHECK(effective(std::vector<std::int8_t>{-128, 127}, -128) == -128);
  CHECK(effective(std::vector<std::uint32_t>{0, 4294967295u}, 4294967295.0) < 4294967295.0);
  CHECK(effective(std::vector<std::uint32_t>{4294967294u, 4294967295u, 0}, 4294967295.0) >
        4294967294.0);
  // Adjacent doubles: nothing lies between, and the surface keeps its level.
  CHECK(effective(std::vector<double>{1, std::nextafter(1, 2)}, std::nextafter(1, 2)) ==
        std::nextafter(1, 2));
  // A billionth of the range is below the last bit of the level: the next number below.
  CHECK(effective(std::vector<double>{1e15, 1e15 + 1}, 1e15 + 1) == std::nextafter(1e15 + 1, 0));
  CHECK(effective(std::vector<float>{0, 0.1f}, static_cast<double>(0.1f)) <
        static_cast<double>(0.1f));
  CHECK(effective(std::vector<float>{0, 0.1f}, 0.1) == 0.1);  // no float32 is 0.1
  const double greatest = std::numeric_limits<double>::max();
  CHECK(effective(std::vector<double>{-greatest, 0, greatest}, 0) < 0);
  CHECK(std::isnan(effective_isovalue(
      Volume::from_samples({2, 1, 1}, {1, 1, 1}, std::vector<float>{0, 1}), NAN)));
}

TEST_CASE("value_range names the first NaN or infinite sample") {
  check_bad_sample(std::numeric_limits<float>::quiet_NaN(), "NaN");
  check_bad_sample(std::numeric_limits<double>::quiet_NaN(), "NaN");
  check_bad_sample(std::numeric_limits<float>::infinity(), "infinite");
  check_bad_sample(-std::numeric_limits<double>::infinity(), "infinite");
}

TEST_CASE("range, isovalue and first bad sample are the same for any number of threads") {
  // More than two tasks. The samples looked for are in the last ones.
  const Index3 dims{256, 256, 70};
  std::vector<float> samples(256 * 256 * 70, 5);
  samples[4'400'000] = 9;
  samples.back() = -3;
  const Volume volume = Volume::from_samples(dims, {1, 1, 1}, samples);
  samples[4'500'001] = std::numeric_limits<float>::infinity();
  samples.back() = std::numeric_limits<float>::quiet_NaN();
  const Volume bad = Volume::from_samples(dims, {1, 1, 1}, samples);
  for (int threads : {1, 2, 5}) {
    CAPTURE(threads);
    const ValueRange range = value_range(volume, "v", threads);
    CHECK(range.min == -3);
    CHECK(range.max == 9);
    CHECK(effective_isovalue(volume, 9, threads) == effective_isovalue(volume, 9));
    CHECK(effective_isovalue(volume, 9, threads) < 9);
    CHECK(effective_isovalue(volume, 8, threads) == 8);
    CHECK(lowered_isovalue(volume, 7, threads).kappa == lowered_isovalue(volume, 7).kappa);
    CHECK_THROWS_WITH_AS(value_range(bad, "v", threads), "v: infinite sample at (33, 170, 68)",
                         InputError);
  }
}

TEST_CASE("a frame maps to the world along its axes, and knows when they are left-handed") {
  const Frame plain;
  CHECK(plain.to_world({1, 2, 3}) == Vec3{1, 2, 3});
  CHECK(!plain.left_handed());
  const Frame turned{{10, 20, 30}, {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  CHECK(turned.to_world({1, 2, 3}) == Vec3{12, 21, 33});
  CHECK(turned.left_handed());
}

TEST_CASE("in blocks the type alone decides how far the isovalue is lowered, past no sample") {
  using enum SampleType;
  for (const SampleType type : {u8, i8, u16, i16, u32, i32}) {
    for (const double kappa : {0.0, 40.0, 40.1, 40.5, 40 + 0x1p-22, -3.0, 4294967295.0}) {
      CAPTURE(kappa);
      const double lowered = isovalue_of_blocks(type, kappa);
      CHECK(lowered < kappa);
      CHECK(lowered > std::ceil(kappa) - 1);
      CHECK(kappa - lowered <= 0x1p-20);
    }
  }
  for (const float kappa : {0.0f, 40.0f, -1e-30f, 1e30f}) {
    const double lowered = isovalue_of_blocks(f32, kappa);
    CHECK(lowered < static_cast<double>(kappa));
    CHECK(lowered >
          static_cast<double>(std::nextafter(kappa, -std::numeric_limits<float>::infinity())));
  }
  CHECK(isovalue_of_blocks(f32, 40.1) == 40.1);
  CHECK(isovalue_of_blocks(f64, 40) == 40);
}
