// SPDX-License-Identifier: MIT
#include "io/volume/builtin_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "base/random.h"
#include "io/files/input_file.h"

namespace deliso {
namespace {

constexpr double kPi = 3.14159265358979323846;

double square(double x) {
  return x * x;
}

// Fields on [-1,1]^3. `width`: the distance between samples.

double sphere(const Vec3& p, double) {
  return 0.7 - length(p);
}

// A torus around the z axis, as distance inside its tube.
double torus_of(const Vec3& p, double major, double minor) {
  return minor - std::sqrt(square(std::sqrt(square(p.x) + square(p.y)) - major) + square(p.z));
}

double torus(const Vec3& p, double) {
  return torus_of(p, 0.6, 0.25);
}

double linked_tori(const Vec3& p, double) {
  const Vec3 a{p.x + 0.22, p.y, p.z};
  const Vec3 b{p.x - 0.22, p.z, p.y};  // around the y axis
  return std::max(torus_of(a, 0.42, 0.15), torus_of(b, 0.42, 0.15));
}

double five_spheres(const Vec3& p, double) {
  constexpr double d = 0.55;
  constexpr Vec3 centers[] = {{d, d, d}, {d, -d, -d}, {-d, d, -d}, {-d, -d, d}};
  double value = 0.32 - length(p);
  double radius = 0.25;
  for (const Vec3& center : centers) {
    value = std::max(value, radius - distance(p, center));
    radius -= 0.03;
  }
  return value;
}

// Two periods of Schoen's gyroid along each axis.
double gyroid(const Vec3& p, double) {
  const double x = 2 * kPi * p.x, y = 2 * kPi * p.y, z = 2 * kPi * p.z;
  return sine(x) * cosine(y) + sine(y) * cosine(z) + sine(z) * cosine(x);
}

// Density of the hydrogen atom's 3d(z^2) state, 1 at most: two lobes and a ring.
double orbital(const Vec3& p, double) {
  const Vec3 q = 18 * p;  // in Bohr radii
  const double r2 = length2(q);
  const double peak = 4 * 1296 * exponential(-4.0);  // on the z axis at z = 6
  return square(3 * q.z * q.z - r2) * exponential(-2.0 / 3.0 * std::sqrt(r2)) / peak;
}

// A plume that enters through the face x = -1, a ring around it on three spokes, two droplets.
double fuel(const Vec3& p, double) {
  const double rho = std::sqrt(square(p.y) + square(p.z));
  const double height = p.x + 0.1 - 0.1 * p.y - 0.05 * p.z;  // over the tilted plane of the ring
  double value = exponential(-square(rho / 0.24)) / (1 + exponential(16 * (p.x - 0.35)));
  value += exponential(-(square((rho - 0.62) / 0.12) + square(height / 0.12)));
  constexpr std::array<std::array<double, 2>, 3> spokes = {
      {{1, 0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}}};
  for (const auto& [c, s] : spokes) {
    const double along = c * p.y + s * p.z, across = c * p.z - s * p.y;
    const double outside = std::max(0.0, std::max(-along, along - 0.62));
    value += 0.8 * exponential(-(square(across) + square(height) + square(outside)) / square(0.15));
  }
  value +=
      exponential(-(square(p.x - 0.75) + square(p.y - 0.3) + square(p.z + 0.2)) / square(0.16));
  value += exponential(-(square(p.x - 0.6) + square(p.y + 0.45) + square(p.z - 0.3)) / square(0.2));
  return value;
}

// Marschner and Lobb 1994, with their parameters: rings close to the sampling limit. Along z it
// falls, so at any resolution the surface is one disk over the square.
double marschner_lobb(const Vec3& p, double) {
  constexpr double frequency = 6, alpha = 0.25;
  const double r = std::sqrt(square(p.x) + square(p.y));
  const double rings = cosine(2 * kPi * frequency * cosine(kPi * r / 2));
  return (1 - sine(kPi * p.z / 2) + alpha * (1 + rings)) / (2 * (1 + alpha));
}

// A block with a bore, four bolt holes, a cross hole into the bore and a cavity; its boundary is
// blurred over three samples, as a scanner would.
double machine(const Vec3& p, double width) {
  const auto round_z = [&](double x, double y) {
    return std::sqrt(square(p.x - x) + square(p.y - y));
  };
  double inside = std::min({0.81 - std::abs(p.x), 0.63 - std::abs(p.y), 0.47 - std::abs(p.z)});
  inside = std::min(inside, round_z(0, 0) - 0.3);
  for (double x : {-0.6, 0.6})
    for (double y : {-0.42, 0.42}) inside = std::min(inside, round_z(x, y) - 0.11);
  const double cross_hole = p.x < 0 ? 1 : std::sqrt(square(p.y) + square(p.z)) - 0.13;
  inside = std::min(inside, cross_hole);
  inside = std::min(inside, distance(p, {-0.55, 0, 0}) - 0.14);
  return 0.5 + inside / (3 * width);
}

Volume volume_of(int size, SampleType type, Buffer samples) {
  const Bytes bytes = bytes_of(std::move(samples), {});
  return {{size, size, size}, {1, 1, 1}, type, bytes.data.data(), bytes.owner};
}

template <class T>
T quantised(double value) {
  if constexpr (std::is_integral_v<T>) {
    constexpr double largest = std::numeric_limits<T>::max();
    return static_cast<T>(std::floor(std::clamp(value, 0.0, 1.0) * largest + 0.5));
  } else {
    return static_cast<T>((std::floor(value * 65536) + 0.5) / 65536);
  }
}

template <class T, double (*field)(const Vec3&, double)>
Volume sampled(int size) {
  const std::size_t n = static_cast<std::size_t>(size);
  Buffer samples(n * n * n * sizeof(T));
  std::byte* to = samples.data.get();
  const auto coordinate = [size](int i) { return (2.0 * i - (size - 1)) / (size - 1); };
  const double width = 2.0 / (size - 1);
  for (int k = 0; k < size; ++k) {
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i, to += sizeof(T)) {
        const T value = quantised<T>(field({coordinate(i), coordinate(j), coordinate(k)}, width));
        std::memcpy(to, &value, sizeof value);
      }
    }
  }
  return volume_of(size, sample_type_of<T>(), std::move(samples));
}

// White noise, smoothed with 1-2-1 along each axis: ambiguous faces and tubes everywhere.
Volume noise(int size) {
  const std::size_t n = static_cast<std::size_t>(size), m = n + 2;
  std::vector<std::uint16_t> values(m * m * m);
  Random random(1);
  for (std::uint16_t& v : values) v = static_cast<std::uint16_t>(random.below(256));
  // In place and towards lower indices, so that each sum reads values not yet replaced.
  for (std::size_t step : {std::size_t{1}, m, m * m})
    for (std::size_t at = 0; at + 2 * step < values.size(); ++at)
      values[at] =
          static_cast<std::uint16_t>(values[at] + 2 * values[at + step] + values[at + 2 * step]);
  Buffer samples(n * n * n);
  std::byte* to = samples.data.get();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        *to++ = static_cast<std::byte>(values[i + m * (j + m * k)] / 64);
  return volume_of(size, SampleType::u8, std::move(samples));
}

constexpr BuiltinField kFields[] = {
    {"sphere", "a sphere", 0, 64, SurfaceTopology{1, 2, 0}},
    {"torus", "a torus", 0, 64, SurfaceTopology{1, 0, 0}},
    {"linked_tori", "two linked tori", 0, 64, SurfaceTopology{2, 0, 0}},
    {"five_spheres", "five spheres of different sizes", 0, 64, SurfaceTopology{5, 10, 0}},
    {"gyroid", "two periods of a gyroid, cut by the box", 0, 64, SurfaceTopology{1, -53, 7}},
    {"orbital", "a hydrogen-like orbital: two lobes and a ring", 3300.5, 64,
     SurfaceTopology{3, 4, 0}},
    {"fuel", "a fuel-like plume with a ring on spokes, cut by the box, and two droplets", 70.5, 64,
     SurfaceTopology{3, -1, 1}},
    {"marschner_lobb", "Marschner and Lobb's test signal, cut by the box", 0.5, 64,
     SurfaceTopology{1, 1, 1}},
    {"machine", "a machine part: a block with bores and a cavity", 127.5, 64,
     SurfaceTopology{2, -8, 0}},
    {"noise", "smoothed white noise, cut by the box", 127.5, 32, std::nullopt},
};
constexpr Volume (*kMakers[])(int size) = {
    sampled<float, sphere>,         sampled<float, torus>,
    sampled<float, linked_tori>,    sampled<float, five_spheres>,
    sampled<float, gyroid>,         sampled<std::uint16_t, orbital>,
    sampled<std::uint8_t, fuel>,    sampled<float, marschner_lobb>,
    sampled<std::uint8_t, machine>, noise};
static_assert(std::size(kFields) == std::size(kMakers));

}  // namespace

std::span<const BuiltinField> builtin_fields() {
  return kFields;
}

Volume sample_builtin_field(const BuiltinField& field, int size) {
  return kMakers[&field - kFields](size);
}

}  // namespace deliso
