// SPDX-License-Identifier: MIT
// Random volumes, of 2 to 12 samples along each axis unless others are asked for, of the kinds that
// meshers fail on. A seed says everything: the kind (seed modulo the number of kinds), size, sample
// type, samples, spacing and isovalue.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "volume/sampled.h"
#include "volume/volume.h"

namespace deliso::stress {

enum class TinyKind : std::uint8_t {
  noise,         // uniform random bytes
  smooth,        // a few random waves
  plateaus,      // two to four levels; half of the isovalues are one of them
  half_way,      // small integers, the isovalue half-way between two: saddles exactly at it
  sheets,        // sheets and gaps one sample thick, in a plane or slanted
  checkerboard,  // samples that alternate, exactly or nearly so
  anisotropic,   // any of these, with spacings up to 1:1:20
};
inline constexpr std::uint64_t kTinyKinds = 7;

inline std::string_view name_of(TinyKind kind) {
  constexpr std::array<std::string_view, kTinyKinds> names{
      "noise", "smooth", "plateaus", "half-way", "sheets", "checkerboard", "anisotropic"};
  return names[static_cast<std::size_t>(kind)];
}

struct TinyVolume {
  Volume volume;
  double isovalue;
};

namespace tiny {

struct Recipe {
  Index3 dims;
  Vec3 spacing{1, 1, 1};
  std::vector<double> samples;  // whole numbers in 0 .. 255 unless `real`
  double isovalue = 0;
  bool real = false;
};

template <class F>
void fill(Recipe& recipe, F f) {
  for_each_index(recipe.dims, [&](int i, int j, int k) { recipe.samples.push_back(f(i, j, k)); });
}

inline void noise(Recipe& r, Random& random) {
  fill(r, [&](int, int, int) { return random.below(256); });
  r.isovalue = random.below(2) ? random.below(256) : random.uniform(0, 255);
}

inline void smooth(Recipe& r, Random& random) {
  struct Wave {
    Vec3 k;
    double phase;
  };
  std::array<Wave, 4> waves;
  const double longest = random.uniform(0.3, 2.5);
  const auto component = [&] { return random.uniform(-longest, longest); };
  for (Wave& wave : waves) {
    wave.k.x = component();
    wave.k.y = component();
    wave.k.z = component();
    wave.phase = random.uniform(0, 6.3);
  }
  r.real = random.below(3) > 0;
  fill(r, [&](int i, int j, int k) {
    double sum = 0;
    for (const Wave& w : waves)
      sum += std::sin(dot(w.k, Vec3{1.0 * i, 1.0 * j, 1.0 * k}) + w.phase);
    const double value = 127.5 + 31 * sum;
    return r.real ? value : std::floor(value);
  });
  r.isovalue = random.uniform(70, 185);
}

inline void plateaus(Recipe& r, Random& random) {
  const std::uint32_t levels = 2 + random.below(3);
  fill(r, [&](int, int, int) { return 10.0 * random.below(levels); });
  const double level = 10.0 * (1 + random.below(levels - 1));
  r.isovalue = random.below(2) ? level : level - random.uniform(0, 10);
}

inline void half_way(Recipe& r, Random& random) {
  const std::uint32_t levels = 2 + random.below(30);
  fill(r, [&](int, int, int) { return random.below(levels); });
  r.isovalue = random.below(levels - 1) + 0.5;
}

inline void sheets(Recipe& r, Random& random) {
  const int slope_x = static_cast<int>(random.below(3)),
            slope_y = static_cast<int>(random.below(3));
  const int period = 2 + static_cast<int>(random.below(4));
  const bool gaps = random.below(2) == 1;
  const std::uint32_t jitter = random.below(2) * random.below(60);
  const std::uint32_t ruined = random.below(20);  // per cent of the samples
  const double level = 100 + random.below(100);
  fill(r, [&](int i, int j, int k) {
    const bool on = (k + (slope_x * i + slope_y * j) / 2) % period == 0;
    double value = on != gaps ? level : 0;
    value += random.below(jitter + 1);
    return random.below(100) < ruined ? random.below(256) : value;
  });
  r.isovalue = random.below(3) == 0 ? level : random.uniform(1, level);
}

inline void checkerboard(Recipe& r, Random& random) {
  const double low = random.below(100), high = 101 + random.below(100);
  const std::uint32_t jitter = random.below(2) * random.below(40);
  const int block = 1 + static_cast<int>(random.below(2));
  fill(r, [&](int i, int j, int k) {
    return ((i / block + j / block + k / block) % 2 == 0 ? low : high) + random.below(jitter + 1);
  });
  const double shares[] = {0.5, 1, random.uniform()};
  r.isovalue = low + (high - low) * shares[random.below(3)];
  if (r.isovalue == low) r.isovalue = high;
}

inline void make(Recipe& r, TinyKind kind, Random& random) {
  switch (kind) {
    case TinyKind::noise:
      return noise(r, random);
    case TinyKind::smooth:
      return smooth(r, random);
    case TinyKind::plateaus:
      return plateaus(r, random);
    case TinyKind::half_way:
      return half_way(r, random);
    case TinyKind::sheets:
      return sheets(r, random);
    case TinyKind::checkerboard:
      return checkerboard(r, random);
    case TinyKind::anisotropic:
      break;
  }
  constexpr double lengths[] = {1, 1, 2.5, 7, 20};
  for (int axis = 0; axis < 3; ++axis) r.spacing[axis] = lengths[random.below(5)];
  make(r, static_cast<TinyKind>(random.below(kTinyKinds - 1)), random);
}

template <class T>
Volume volume_of(const Recipe& r) {
  return Volume::from_samples(r.dims, r.spacing,
                              std::vector<T>(r.samples.begin(), r.samples.end()));
}

// Returns the samples in a type that the generator draws.
inline TinyVolume of_some_type(const Recipe& r, Random& random) {
  const std::uint32_t type = random.below(4);
  if (r.real) return {type % 2 ? volume_of<double>(r) : volume_of<float>(r), r.isovalue};
  if (type == 0) return {volume_of<std::int16_t>(r), r.isovalue};
  if (type == 1) return {volume_of<float>(r), r.isovalue};
  return {volume_of<std::uint8_t>(r), r.isovalue};
}

}  // namespace tiny

inline TinyKind kind_of(std::uint64_t seed) {
  return static_cast<TinyKind>(seed % kTinyKinds);
}

inline TinyVolume make_tiny_volume(std::uint64_t seed, int least = 2, int most = 12) {
  Random random(seed);
  tiny::Recipe r;
  const auto sizes = static_cast<std::uint32_t>(most - least + 1);
  for (int axis = 0; axis < 3; ++axis) r.dims[axis] = least + static_cast<int>(random.below(sizes));
  tiny::make(r, kind_of(seed), random);
  return tiny::of_some_type(r, random);
}

// As a file that the program reads.
inline void write_nrrd(const Volume& volume, const std::string& path) {
  const Index3 n = volume.dims();
  const Vec3 s = volume.spacing();
  std::ofstream out(path, std::ios::binary);
  out.precision(17);
  out << "NRRD0004\ntype: " << name_of(volume.type())
      << "\ndimension: 3\nspace: right-anterior-superior\nsizes: " << n.i << ' ' << n.j << ' '
      << n.k << "\nspace directions: (" << s.x << ",0,0) (0," << s.y << ",0) (0,0," << s.z
      << ")\nendian: little\nencoding: raw\n\n";
  volume.visit([&](const auto* samples) {
    out.write(reinterpret_cast<const char*>(samples),
              static_cast<std::streamsize>(volume.sample_count() * sizeof *samples));
  });
}

}  // namespace deliso::stress
