// SPDX-License-Identifier: MIT
// Random label volumes, of 2 to 30 labels, of the kinds at which borders of labels go wrong. 2 to
// 24 samples along each axis, mostly few, and spacings up to 1:1:10. A seed says everything: the
// kind (seed modulo the number of kinds), size, labels, samples, spacing and smoothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/random.h"
#include "base/text.h"
#include "io/filter/label_fields.h"
#include "more/bodies/partition.h"
#include "volume/sampled.h"
#include "volume/volume.h"

namespace deliso::stress {

enum class LabelKind : std::uint8_t {
  noise,     // a label for each sample
  runs,      // of samples along x
  cells,     // of a Voronoi diagram
  islands,   // cells, with single samples of other labels
  layers,    // one sample thin, in a plane or slanted
  checkers,  // of two labels, or of all in turn; with single samples of others
  balls,     // in balls, with shells of one sample and more
  boxes,     // in boxes, likewise
  touching,  // boxes that meet their neighbors at one edge or one corner
  at_box,    // boxes at faces, edges and corners of the volume
};
inline constexpr std::uint64_t kLabelKinds = 10;

inline std::string_view name_of(LabelKind kind) {
  constexpr std::array<std::string_view, kLabelKinds> names{
      "noise",    "runs",  "cells", "islands",  "layers",
      "checkers", "balls", "boxes", "touching", "at-box"};
  return names[static_cast<std::size_t>(kind)];
}
inline LabelKind label_kind_of(std::uint64_t seed) {
  return static_cast<LabelKind>(seed % kLabelKinds);
}

struct LabelVolume {
  Volume volume;
  int median = 0;
  double smooth = 0;  // voxels

  // Returns the options that smooth its labels.
  std::string words() const {
    return (median > 0 ? text(" --median ", median) : "") + text(" --smooth ", smooth, "vox");
  }
};

namespace labels {

// The numbers 0 to `labels` - 1, which stand for labels, of the samples.
struct Drawing {
  Index3 dims;
  std::uint32_t labels;
  std::vector<std::uint32_t> of_sample;

  std::uint32_t& at(Index3 s) {
    return of_sample[static_cast<std::size_t>(s.i + dims.i * (s.j + dims.j * s.k))];
  }
};

template <class F>
void fill(Drawing& d, F f) {
  for_each_index(d.dims, [&](int i, int j, int k) {
    d.at({i, j, k}) = static_cast<std::uint32_t>(f(i, j, k)) % d.labels;
  });
}

inline Index3 any_sample(const Drawing& d, Random& random) {
  Index3 s;
  for (int axis = 0; axis < 3; ++axis) {
    s[axis] = static_cast<int>(random.below(static_cast<std::uint32_t>(d.dims[axis])));
  }
  return s;
}

// Gives a label to the samples in a box, which is cut off at the volume.
inline void fill_box(Drawing& d, Index3 first, Index3 last, std::uint32_t label) {
  for_each_index(d.dims, [&](int i, int j, int k) {
    const bool is_in =
        first.i <= i && i <= last.i && first.j <= j && j <= last.j && first.k <= k && k <= last.k;
    if (is_in) d.at({i, j, k}) = label;
  });
}

inline void spoil(Drawing& d, Random& random, std::uint32_t one_of) {
  for (std::uint32_t& label : d.of_sample) {
    if (random.below(one_of) == 0) label = random.below(d.labels);
  }
}

inline void runs(Drawing& d, Random& random) {
  const std::uint32_t longest = 2 + random.below(8);
  std::uint32_t left = 0, label = 0;
  fill(d, [&](int, int, int) {
    if (left == 0) {
      left = 1 + random.below(longest);
      label = random.below(d.labels);
    }
    --left;
    return label;
  });
}

inline void cells(Drawing& d, Random& random) {
  std::vector<Vec3> centers(d.labels + random.below(d.labels));
  for (Vec3& c : centers) {
    for (int axis = 0; axis < 3; ++axis) c[axis] = random.uniform(-0.5, d.dims[axis] - 0.5);
  }
  fill(d, [&](int i, int j, int k) {
    const Vec3 p = to_vec3({i, j, k});
    return std::ranges::min_element(centers, {}, [&](const Vec3& c) { return distance2(c, p); }) -
           centers.begin();
  });
}

inline void layers(Drawing& d, Random& random) {
  const std::uint32_t sx = random.below(3), sy = random.below(3), period = 1 + random.below(4);
  const bool is_thin = random.below(2) == 0;  // a thin layer every `period`; else all are thin
  fill(d, [&](int i, int j, int k) {
    const auto n = static_cast<std::uint32_t>(k) +
                   (sx * static_cast<std::uint32_t>(i) + sy * static_cast<std::uint32_t>(j)) / 2;
    return is_thin ? (n % (period + 1) == 0 ? 1 + n / (period + 1) % (d.labels - 1) : 0) : n;
  });
  if (random.below(3) == 0) spoil(d, random, 10);  // holes
}

inline void checkers(Drawing& d, Random& random) {
  const int side = 1 + static_cast<int>(random.below(2));
  const std::uint32_t colors = random.below(2) == 0 ? 2 : d.labels;
  fill(d, [&](int i, int j, int k) {
    return static_cast<std::uint32_t>(i / side + j / side + k / side) % colors;
  });
  if (random.below(2) == 0) spoil(d, random, 4 + random.below(20));
}

// Shells about a center, by the distance that `norm` gives.
template <class Norm>
void nest(Drawing& d, Random& random, Norm norm) {
  Vec3 center;
  for (int axis = 0; axis < 3; ++axis) center[axis] = random.uniform(0, d.dims[axis] - 1);
  const double thickness = random.uniform(0.8, 2.5), first = random.uniform(0, 2);
  fill(d, [&](int i, int j, int k) {
    const Vec3 away = to_vec3({i, j, k}) - center;
    return std::min(std::floor(std::max(0.0, norm(away) - first) / thickness), d.labels - 1.0);
  });
}

inline void touching(Drawing& d, Random& random) {
  const int side = 1 + static_cast<int>(random.below(3));
  for (std::uint32_t label = 1; label < d.labels; ++label) {
    const Index3 first = any_sample(d, random), last = first + Index3{side - 1, side - 1, side - 1};
    fill_box(d, first, last, label);
    // Its neighbor begins beyond its end along two or three axes.
    const std::uint32_t level = random.below(4);
    Index3 next = last + Index3{1, 1, 1};
    if (level < 3) next[static_cast<int>(level)] = first[static_cast<int>(level)];
    fill_box(d, next, next + Index3{side - 1, side - 1, side - 1}, 1 + random.below(d.labels - 1));
  }
}

inline void at_box(Drawing& d, Random& random) {
  for (std::uint32_t label = 1; label < d.labels; ++label) {
    const Index3 middle = any_sample(d, random);
    Index3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
      const int end = d.dims[axis] - 1, depth = static_cast<int>(random.below(3));
      const std::uint32_t place = random.below(4);
      first[axis] = place == 0 ? 0 : place == 1 ? end - depth : middle[axis];
      last[axis] = place == 0 ? depth : place == 1 ? end : middle[axis] + depth;
    }
    fill_box(d, first, last, label);
  }
}

inline Drawing drawn(LabelKind kind, Index3 dims, std::uint32_t count, Random& random) {
  Drawing d{dims, count, {}};
  d.of_sample.resize(static_cast<std::size_t>(dims.i) * static_cast<std::size_t>(dims.j) *
                     static_cast<std::size_t>(dims.k));
  switch (kind) {
    case LabelKind::noise:
      spoil(d, random, 1);
      break;
    case LabelKind::runs:
      runs(d, random);
      break;
    case LabelKind::cells:
      cells(d, random);
      break;
    case LabelKind::islands:
      cells(d, random);
      spoil(d, random, 5 + random.below(30));
      break;
    case LabelKind::layers:
      layers(d, random);
      break;
    case LabelKind::checkers:
      checkers(d, random);
      break;
    case LabelKind::balls:
      nest(d, random, [](const Vec3& p) { return length(p); });
      break;
    case LabelKind::boxes:
      nest(d, random, [](const Vec3& p) {
        return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
      });
      break;
    case LabelKind::touching:
      touching(d, random);
      break;
    case LabelKind::at_box:
      at_box(d, random);
      break;
  }
  return d;
}

}  // namespace labels

inline LabelVolume make_label_volume(std::uint64_t seed, std::uint32_t longest = 24) {
  Random random(seed * 7919);
  constexpr std::uint32_t kMost[] = {3, 3, 4, 4, 5, 5, 6, 6, 7, 8, 9, 12, 16, 24};
  const std::uint32_t most = std::min(kMost[random.below(std::size(kMost))], longest);
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) dims[axis] = static_cast<int>(2 + random.below(most - 1));
  const std::uint32_t count = 2 + random.below(random.below(3) > 0 ? 4 : 29);
  // Numbers of labels, in a random order; 0 is the background.
  std::vector<std::int32_t> label;
  const bool has_background = random.below(4) > 0;
  for (std::uint32_t n = 0; n < count; ++n)
    label.push_back(static_cast<std::int32_t>(n) + (has_background ? 0 : 5));
  if (random.below(3) == 0) {
    for (std::uint32_t n = count; n > 1; --n) std::swap(label[n - 1], label[random.below(n)]);
  }
  constexpr double kLengths[] = {1, 1, 1, 2.5, 10};
  Vec3 spacing{1, 1, 1};
  if (random.below(2) == 0) {
    for (int axis = 0; axis < 3; ++axis) spacing[axis] = kLengths[random.below(5)];
  }
  const labels::Drawing drawing = labels::drawn(label_kind_of(seed), dims, count, random);
  std::vector<std::int32_t> samples;
  for (const std::uint32_t n : drawing.of_sample) samples.push_back(label[n]);
  constexpr double kSmooth[] = {0.3, 0.5, 1, 2};
  LabelVolume made{Volume::from_samples(dims, spacing, samples), 0, kSmooth[random.below(4)]};
  if (random.below(6) == 0) made.median = 1 + static_cast<int>(random.below(2));
  if (random.below(8) == 0) made.smooth = 0;
  return made;
}

inline LabelVolume mirrored(const LabelVolume& labels, int axis) {
  const Volume& volume = labels.volume;
  const Index3 n = volume.dims();
  std::vector<std::int32_t> samples;
  for (int k = 0; k < n.k; ++k) {
    for (int j = 0; j < n.j; ++j) {
      for (int i = 0; i < n.i; ++i) {
        Index3 at{i, j, k};
        at[axis] = n[axis] - 1 - at[axis];
        samples.push_back(static_cast<std::int32_t>(volume.sample(at.i, at.j, at.k)));
      }
    }
  }
  LabelVolume other = labels;
  other.volume = Volume::from_samples(n, volume.spacing(), samples);
  return other;
}

// Returns the bodies of its labels, as the program has them.
inline Partition partition_of(const LabelVolume& labels, int threads = 1) {
  const Volume& volume = labels.volume;
  IndicatorFilter filter{labels.median, {}};
  for (int axis = 0; axis < 3; ++axis) {
    filter.sigma[axis] = labels.smooth * volume.voxel() / volume.spacing()[axis];
  }
  LabelFields all(volume, find_labels(volume, "labels", threads), {}, filter, "labels", threads);
  std::vector<Volume> fields;
  BodyId background = kNoId;
  for (const LabelSamples& l : all.weighed()) {
    if (l.label == 0) background = static_cast<BodyId>(fields.size());
    fields.push_back(all.weighted(l.label));
  }
  return Partition(volume, std::move(fields), background, threads, all.kept());
}

}  // namespace deliso::stress
