// SPDX-License-Identifier: MIT
#include "volume/volume.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "refusal.h"
#include "volume/sampled.h"
#include "volume/volume_source.h"

using namespace deliso;

namespace {

// Calls f with a zero of each type of samples.
template <class F>
void for_each_type(F&& f) {
  const auto call = [&](auto... zeros) { (f(zeros), ...); };
  call(std::uint8_t{}, std::int8_t{}, std::uint16_t{}, std::int16_t{}, std::uint32_t{},
       std::int32_t{}, float{}, double{});
}

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
  for_each_index(volume.dims(), [&](int i, int j, int k) {
    const Vec3 at = volume.position({i, j, k});
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis)
      weight *= std::max(0.0, 1 - std::abs(p[axis] - at[axis]) / volume.spacing()[axis]);
    sum += weight * volume.sample(i, j, k);
  });
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
  for_each_index(dims, [&](int i, int j, int k) {
    REQUIRE(std::abs(volume.value(volume.position({i, j, k})) - volume.sample(i, j, k)) <=
            1e-13 * scale);
  });
  const Vec3 top = volume.box().hi;
  for (int n = 0; n < 20; ++n) {
    const Vec3 p{random.uniform(-5, 20), random.uniform(-5, 20), random.uniform(-5, 20)};
    const Vec3 inside{std::clamp(p.x, 0.0, top.x), std::clamp(p.y, 0.0, top.y),
                      std::clamp(p.z, 0.0, top.z)};
    REQUIRE(std::abs(volume.value(p) - weighted_sum(volume, inside)) <= 1e-13 * scale);
  }
}

template <class T>
void check_range(std::uint64_t seed, std::size_t count, std::uint32_t values) {
  Random random(seed);
  std::vector<T> samples = random_samples<T>(random, count);
  if (values > 0)  // few different values: plateaus
    for (T& s : samples) s = static_cast<T>(random.below(values));
  const Volume volume = Volume::from_samples({static_cast<int>(count), 1, 1}, {1, 1, 1}, samples);
  const ValueRange range = value_range(volume);
  CAPTURE(seed);
  CHECK(range.min == static_cast<double>(*std::min_element(samples.begin(), samples.end())));
  CHECK(range.max == static_cast<double>(*std::max_element(samples.begin(), samples.end())));
}

// The rule at an isovalue and one sample: it may be lowered, but past no sample and onto none.
template <class T>
void check_side(T sample, double isovalue) {
  const double kappa = geometric_isovalue(sample_type_of<T>(), isovalue);
  const double value = static_cast<double>(sample);
  CAPTURE(value);
  CAPTURE(isovalue);
  CHECK(kappa <= isovalue);
  CHECK((value >= kappa) == (value >= isovalue));
  if (sizeof(T) < 8) CHECK(value != kappa);
}

template <class T>
void check_sides(Random& random) {
  using Limits = std::numeric_limits<T>;
  std::vector<T> samples = random_samples<T>(random, 200);
  // The limits are no isovalues with something on either side, but their neighbors are.
  for (const T s : {T{0}, T{1}, T{40}, static_cast<T>(-3), Limits::max()}) samples.push_back(s);
  for (const T s : samples) {
    if (s == Limits::lowest()) continue;
    const double value = static_cast<double>(s);
    T below = static_cast<T>(s - 1), above = s == Limits::max() ? s : static_cast<T>(s + 1);
    if constexpr (std::is_floating_point_v<T>) {
      below = std::nextafter(s, Limits::lowest());
      above = std::nextafter(s, Limits::max());
    }
    for (const T sample : {below, s, above}) {
      for (const double isovalue :
           {value, value - 0.25, value + 0.5, value + 0.1, value - 0x1p-22,
            0.5 * (value + static_cast<double>(below)), std::nextafter(value, 1e300)}) {
        if (isovalue > static_cast<double>(Limits::lowest())) check_side(sample, isovalue);
      }
    }
  }
}

template <class T>
void check_bad_sample(T bad, const char* word) {
  for (int n : {0, 1, 5, 59, 4095, 4096, 8191, 9999}) {
    std::vector<T> samples(10000, T{3});
    samples[static_cast<std::size_t>(n)] = bad;
    samples[9999] = bad;
    const Volume volume = Volume::from_samples({10, 20, 50}, {1, 1, 1}, samples);
    const std::string expected =
        std::string("v.nrrd: ") + word + " sample at (" + std::to_string(n % 10) + ", " +
        std::to_string(n / 10 % 20) + ", " + std::to_string(n / 200) + ")" +
        (std::isnan(bad) ? ": --nan VALUE gives such samples a value" : "");
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
    for_each_type([&]<class T>(T) { check_interpolation<T>(seed); });
  }
}

TEST_CASE("corner m of a voxel is a sample; voxel_at is clamped to the box") {
  std::vector<std::uint16_t> samples(3 * 4 * 5);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = static_cast<std::uint16_t>(n);
  const Volume volume = Volume::from_samples({3, 4, 5}, {0.5, 2, 4}, samples);
  CHECK(volume.voxels() == Index3{2, 3, 4});
  CHECK(volume.box().hi == Vec3{1, 6, 16});
  for_each_index({2, 3, 4}, [&](int i, int j, int k) {
    for (int m = 0; m < 8; ++m)
      CHECK(volume.corners({i, j, k})[static_cast<std::size_t>(m)] ==
            volume.sample(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2)));
  });
  CHECK(volume.voxel_at({-1, -1, -1}) == Index3{0, 0, 0});
  CHECK(volume.voxel_at({0.5, 2, 4}) == Index3{1, 1, 1});
  CHECK(volume.voxel_at({1, 6, 16}) == Index3{1, 2, 3});
  CHECK(volume.voxel_at({1e300, 1e300, 1e300}) == Index3{1, 2, 3});
}

TEST_CASE("samples may lie at places of their own along an axis") {
  const Coordinates places{{{}, {0, 1, 1.5, 4}, {0, 2, 2.25, 7, 8, 8.125}}};
  const Volume even = sampled<float>({3, 4, 6}, {0.5, 1, 1},
                                     [](int i, int j, int k) { return 3 * i - 2 * j * k + k * k; });
  const Volume volume = even.with_places(places, "test");
  CHECK(volume.spacing() == Vec3{0.5, 1, 1});
  CHECK(volume.least_spacing() == Vec3{0.5, 0.5, 0.125});
  CHECK(volume.box().hi == Vec3{1, 4, 8.125});
  const Volume block = samples_of(volume, {{0, 1, 2}, {2, 3, 5}});
  const Grid crop = volume.cropped({0, 1, 2}, {3, 3, 4});
  for (int n = 0; n < 36; ++n) {
    const Index3 at{n % 3, n / 3 % 3, n / 9}, in_all = at + Index3{0, 1, 2};
    const Vec3 p = volume.position(in_all);
    CHECK(p == Vec3{0.5 * in_all.i, places[1][in_all.j], places[2][in_all.k]});
    CHECK(block.position(at) == p);
    CHECK(crop.frame().to_world(crop.position(at)) == p);
    CHECK(volume.value(p) == even.sample(in_all.i, in_all.j, in_all.k));
    CHECK(block.value(p) == volume.value(p));
  }
  Random random(3);
  for (int n = 0; n < 500; ++n) {
    // Between the samples all is as with even steps, but for the sides of the voxel.
    const Vec3 u{random.uniform(0, 2), random.uniform(0, 3), random.uniform(0, 5)};
    const Vec3 p = volume.at_samples(u), even_p = even.at_samples(u);
    CHECK(distance(volume.in_all_samples(p), u) < 1e-14);
    CHECK(volume.voxel_at(p) == even.voxel_at(even_p));
    CHECK(volume.value(p) == doctest::Approx(even.value(even_p)).epsilon(1e-12));
    const Vec3 sides = volume.sides(volume.voxel_at(p)), slope = even.gradient(even_p);
    CHECK(distance(times(volume.gradient(p), sides), times(slope, even.spacing())) < 1e-11);
    if (block.box().contains(p)) CHECK(distance(block.gradient(p), volume.gradient(p)) < 1e-11);
  }
  const auto message = [&](Coordinates wrong) {
    return test::refusal_by([&] { even.with_places(std::move(wrong), "v"); });
  };
  CHECK(message({{{0, 1}, {}, {}}}) == "v: has 3 samples along x, and 2 coordinates");
  CHECK(message({{{0, 1, 1}, {}, {}}}) == "v: its coordinates along x do not increase at sample 2");
  CHECK(message({{{0, 1, std::nan("")}, {}, {}}}).find("do not increase") != std::string::npos);
  CHECK(message({{{0, 1, 1e31}, {}, {}}}) == "v: its coordinates along x are out of range");
}

TEST_CASE("the range of any number of samples, with or without plateaus") {
  std::uint64_t seed = 0;
  for (std::size_t count : {1u, 2u, 7u, 63u, 64u, 65u, 1000u, 4096u, 4097u, 20000u}) {
    for (std::uint32_t values : {0u, 1u, 2u, 5u, 100u}) {
      for_each_type([&]<class T>(T) { check_range<T>(seed++, count, values); });
    }
  }
}

TEST_CASE("value_range names the first NaN or infinite sample") {
  check_bad_sample(std::numeric_limits<float>::quiet_NaN(), "NaN");
  check_bad_sample(std::numeric_limits<double>::quiet_NaN(), "NaN");
  check_bad_sample(std::numeric_limits<float>::infinity(), "infinite");
  check_bad_sample(-std::numeric_limits<double>::infinity(), "infinite");
  std::vector<float> samples(8);
  samples[6] = std::numeric_limits<float>::quiet_NaN();
  const Grid grid = Grid({50, 50, 50}, {1, 1, 1}, SampleType::f32).part({10, 20, 30}, {2, 2, 2});
  const Volume block = Volume::from_samples(grid, samples);
  CHECK_THROWS_WITH_AS(value_range(block, "v.nrrd"),
                       "v.nrrd: NaN sample at (10, 21, 31): --nan VALUE gives such samples a value",
                       InputError);
}

// From 5e307 on the caps ended with an internal error, and from 1e154 on they were not sound.
TEST_CASE("value_range refuses samples of which products overflow") {
  const auto at = [](double large) {
    std::vector<double> samples(1000, -1);
    samples[345] = large;
    return Volume::from_samples({10, 10, 10}, {1, 1, 1}, samples);
  };
  CHECK(value_range(at(1e75)).max == 1e75);
  CHECK(value_range(at(-1e75)).min == -1e75);
  for (const double large : {1.001e75, -1.001e75, 1e300, -5e307}) {
    CHECK_THROWS_WITH_AS(
        value_range(at(large), "v.npy"),
        text("v.npy: the sample at (5, 4, 3) is ", large,
             ", out of range (-1e+75 to 1e+75): scale all samples, or replace a fill value")
            .c_str(),
        InputError);
  }
  constexpr float kLargestFloat = std::numeric_limits<float>::max();
  const std::vector<float> floats(8, kLargestFloat);
  CHECK(value_range(Volume::from_samples({2, 2, 2}, {1, 1, 1}, floats)).max == kLargestFloat);
}

// A join died since it asked the gradient of a field of which it had no samples.
template <class T>
constexpr bool kHasGradient = requires(const T& t, const Vec3& p) {
  t.gradient(p);
};
template <class T>
constexpr bool kHasSamples = requires(const T& t) {
  t.sample(0, 0, 0);
};
static_assert(kHasGradient<Volume> && kHasSamples<Volume>);
static_assert(!kHasGradient<Grid> && !kHasSamples<Grid>);
static_assert(std::is_same_v<decltype(VolumeSource::shape), Grid>);

TEST_CASE("a volume has samples, and a source reads what it needs for a gradient") {
  CHECK_THROWS_AS(Volume({2, 2, 2}, {1, 1, 1}, SampleType::u8, nullptr, nullptr), InternalError);
  Random random(7);
  const Volume whole =
      Volume::from_samples({5, 6, 7}, {0.7, 1, 1.3}, random_samples<float>(random, 210));
  VolumeSource source = source_of(whole);
  source.in_memory.reset();
  source.read = [&](const SampleBox& box) {
    CHECK(box.dims() == Index3{2, 2, 2});
    return samples_of(whole, box);
  };
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = random_point(whole, random);
    CHECK(gradient_at(source, p) == whole.gradient(p));
  }
  CHECK(gradient_at(source, whole.box().hi) == whole.gradient(whole.box().hi));
}

TEST_CASE("a frame maps to the world along its axes, and knows when they are left-handed") {
  const Frame plain;
  CHECK(plain.to_world({1, 2, 3}) == Vec3{1, 2, 3});
  CHECK(!plain.left_handed());
  const Frame turned{{10, 20, 30}, {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  CHECK(turned.to_world({1, 2, 3}) == Vec3{12, 21, 33});
  CHECK(turned.left_handed());
}

TEST_CASE("the isovalue of the geometry is lowered onto no sample and past none") {
  Random random(61);
  for_each_type([&]<class T>(T) { check_sides<T>(random); });
}

TEST_CASE("the isovalue of the geometry depends on the type and the isovalue alone") {
  using enum SampleType;
  for (const SampleType type : {u8, i8, u16, i16, u32, i32}) {
    for (const double isovalue : {0.0, 40.0, -3.0, 4294967295.0}) {
      CAPTURE(isovalue);
      CHECK(geometric_isovalue(type, isovalue) == isovalue - 0.38196601125);
    }
    CHECK(geometric_isovalue(type, 40.5) == 40.5 - 0x1p-20);
    CHECK(geometric_isovalue(type, 40.1) == 40.1);
  }
  CHECK(geometric_isovalue(u8, 40 + 0x1p-9) == 40 + 0x1p-9);
  CHECK(geometric_isovalue(u16, 40 + 0x1p-9) < 40 + 0x1p-9);
  CHECK(geometric_isovalue(f32, 40) == 40 - 0x1p-19);
  CHECK(geometric_isovalue(f32, 40.1) == 40.1);  // no float32 is 40.1
  CHECK(geometric_isovalue(f64, 40) == 40);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const SampleType type : {u8, i32, f32, f64}) {
    for (const double isovalue : {1e300, -1e300, infinite, -infinite}) {
      CHECK(geometric_isovalue(type, isovalue) == isovalue);
    }
    CHECK(std::isnan(geometric_isovalue(type, NAN)));
  }
}

// The saddle of a bilinear face is (ab - pq) / (a + b - p - q).
TEST_CASE("no saddle of a face of 8-bit samples lies at the isovalue of the geometry") {
  Random random(62);
  int tied = 0;
  for (int trial = 0; trial < 1'000'000; ++trial) {
    const auto draw = [&] { return static_cast<std::int64_t>(random.below(256)); };
    const std::int64_t a = draw(), b = draw(), p = draw(), q = draw();
    if (std::min(a, b) <= std::max(p, q)) continue;
    const std::int64_t above = a * b - p * q, below = a + b - p - q;
    const double saddle = static_cast<double>(above) / static_cast<double>(below);
    const double kappa = geometric_isovalue(SampleType::u8, saddle);
    if (kappa == saddle) {
      REQUIRE((below & (below - 1)) != 0);  // no double is this saddle
      continue;
    }
    ++tied;
    // Rounded once, so it is 0 only if kappa is the saddle.
    REQUIRE(std::fma(kappa, static_cast<double>(below), -static_cast<double>(above)) != 0);
  }
  CHECK(tied > 1000);
}

TEST_CASE(
    "a grid without samples, too far away or in a skew frame is refused, and a wrong number of "
    "samples") {
  const auto message = [](auto&& make) {
    try {
      make();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto framed = [&](Index3 dims, const Frame& frame) {
    return message([&] { Grid(dims, {1, 1, 1}, SampleType::u8, frame); });
  };
  Frame frame;
  CHECK(framed({2, 3, 4}, frame) == "");
  CHECK(framed({2, 0, 4}, frame) == "volume: has 0 samples along y");
  frame.axes[1] = {0, 2, 0};
  CHECK(framed({2, 3, 4}, frame) == "volume: an axis of its frame is no unit vector");
  frame = {};
  frame.origin = {0, 0, 1e31};
  CHECK(framed({2, 3, 4}, frame).starts_with("volume: its origin is further than "));
  const std::vector<float> few(7);
  CHECK(message([&] {
          Volume::from_samples({2, 2, 2}, {1, 1, 1}, few);
        }) == "a volume of 2 x 2 x 2 samples is given 7");
}
