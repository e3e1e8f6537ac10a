// SPDX-License-Identifier: MIT
#include "io/filter/label_fields.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// Five cells of a Voronoi diagram, the last of them 0, with a sheet 7 one voxel thick, and labels
// 8, 9 and 10 of one voxel: in the sheet, in a cell, and beside that.
constexpr Index3 kCells{26, 24, 28}, kWide{42, 40, 44};
Volume cells(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> centers(5);
  for (Vec3& c : centers) {
    c = {random.uniform(0, 26), random.uniform(0, 24), random.uniform(0, 28)};
  }
  return sampled<std::uint8_t>(kCells, {1, 1, 1}, [&](int i, int j, int k) {
    if (k == 14 && j > 4 && j < 20 && i < 12) return i == 6 && j == 12 ? 8 : 7;
    if (k == 5 && j == 9 && (i == 15 || i == 16)) return i == 15 ? 9 : 10;
    const Vec3 p{double(i), double(j), double(k)};
    const auto nearest =
        std::ranges::min_element(centers, {}, [&](const Vec3& c) { return distance2(c, p); });
    return static_cast<int>((nearest - centers.begin() + 1) % 5);
  });
}

LabelFields fields_of(const Volume& volume, const IndicatorFilter& filter,
                      const std::vector<std::int64_t>& united = {}, int threads = 2) {
  return {volume, find_labels(volume, "v"), united, filter, "v", threads};
}

// Returns the greatest sample of a field, and 0 if none is above.
double greatest(const Volume& field) {
  return std::max(0.0, value_range(field).max);
}

Volume ball(int n, double radius, const Vec3& center, int inner) {
  return sampled<std::uint8_t>({n, n, n}, {1, 1, 1}, [&](int i, int j, int k) {
    const Vec3 d = Vec3{double(i), double(j), double(k)} - center;
    return dot(d, d) > radius * radius ? 0 : dot(d, d) < 1 ? inner : 3;
  });
}

}  // namespace

TEST_CASE("the field of a label is its weighted indicator less the largest other one") {
  for (const IndicatorFilter filter :
       {IndicatorFilter{0, {1, 1, 1}}, IndicatorFilter{1, {1.3, 0.6, 0.9}}}) {
    const Volume volume = cells(3);
    const bool keeps = filter.median == 0;
    LabelFields fields = fields_of(volume, filter);
    const std::vector<LabelSamples> labels = fields.weighed();
    REQUIRE(labels.size() == 9);
    std::vector<Volume> weighted;  // of the whole volume
    for (const LabelSamples& l : labels) {
      // The outermost samples go on for 8 more.
      const Volume indicator = sampled<std::uint8_t>(kWide, {1, 1, 1}, [&](int i, int j, int k) {
        return volume.sample(std::clamp(i - 8, 0, 25), std::clamp(j - 8, 0, 23),
                             std::clamp(k - 8, 0, 27)) == static_cast<double>(l.label);
      });
      const Volume s =
          gaussian(filter.median > 0 ? median(indicator, filter.median) : indicator, filter.sigma);
      weighted.push_back(sampled<float>(kCells, {1, 1, 1}, [&](int i, int j, int k) {
        return static_cast<float>(l.weight * s.sample(i + 8, j + 8, k + 8));
      }));
    }
    int wrong = 0, opposite = 0, outside = 0, otherwise_weighted = 0;
    for (std::size_t l = 0; l < labels.size(); ++l) {
      CAPTURE(labels[l].label);
      const Volume field = fields.field(labels[l].label);
      const Volume own = fields.weighted(labels[l].label);  // of the same box
      CHECK(own.dims() == field.dims());
      CHECK(own.whole_dims() == kCells);
      const Vec3 at = field.frame().origin;
      CHECK(to_vec3(own.first()) == at);
      for_each_index(kCells, [&](int i, int j, int k) {
        float others = 1e-30F;
        for (std::size_t m = 0; m < labels.size(); ++m) {
          if (m == l) continue;
          others = std::max(others, static_cast<float>(weighted[m].sample(i, j, k)));
        }
        const auto value = static_cast<float>(weighted[l].sample(i, j, k));
        float expected = value - others;
        if (keeps && volume.sample(i, j, k) == static_cast<double>(labels[l].label)) {
          expected = std::max(expected, kAhead * others);
        } else if (keeps) {
          expected = std::min(expected, -kAhead * value);
        }
        const Index3 here{i - int(at.x), j - int(at.y), k - int(at.z)}, n = field.dims();
        const bool is_in = here.i >= 0 && here.i < n.i && here.j >= 0 && here.j < n.j &&
                           here.k >= 0 && here.k < n.k;
        const double sample = is_in ? own.sample(here.i, here.j, here.k) : 0;
        otherwise_weighted += sample != weighted[l].sample(i, j, k);
        if (is_in) {
          wrong += field.sample(here.i, here.j, here.k) != static_cast<double>(expected);
          opposite += expected > 0;
        } else {
          outside += expected >= 0;
        }
      });
    }
    CHECK(wrong == 0);  // so f_M = -f_L where L and M are the two largest, and f_L + f_M <= 0
    CHECK(outside == 0);
    CHECK(otherwise_weighted == 0);
    CHECK(opposite > 0.99 * 26 * 24 * 28);  // nearly every sample is inside one label
  }
}

TEST_CASE("a label has the same weight and field alone, among all, and in any number of threads") {
  const Volume volume = cells(5);
  const IndicatorFilter filter{0, {1, 0.8, 1.2}};
  LabelFields all = fields_of(volume, filter, {}, 3);
  for (const LabelSamples& l : all.weighed()) {
    LabelFields alone = fields_of(volume, filter, {l.label}, 1);
    CHECK(alone.weighed(l.label).weight == l.weight);
    const Volume a = all.field(l.label), b = alone.field(l.label);
    CHECK(same_samples(a, b));
  }
}

TEST_CASE("labels that count as one have the field of one label") {
  const Volume volume = cells(7);
  const Volume joined = sampled<std::uint8_t>(kCells, {1, 1, 1}, [&](int i, int j, int k) {
    const int label = static_cast<int>(volume.sample(i, j, k));
    return label == 4 || label == 7 ? 2 : label;
  });
  const IndicatorFilter filter{0, {1, 1, 1}};
  const Volume a = fields_of(volume, filter, {2, 4, 7}).field(2);
  const Volume b = fields_of(joined, filter, {2}).field(2);
  CHECK(same_samples(a, b));
}

TEST_CASE("labels of one voxel and sheets of one keep their volume, wherever they are") {
  for (const double sigma : {0.7, 1.0, 2.0}) {
    for (const std::uint64_t seed : {3, 5, 8}) {
      CAPTURE(sigma);
      CAPTURE(seed);
      LabelFields fields = fields_of(cells(seed), {0, {sigma, sigma, sigma}});
      for (const std::int64_t label : {7, 8, 9, 10}) {
        CAPTURE(label);
        const Volume field = fields.field(label);
        CHECK(greatest(field) > 0);
        const double volume = inside_volume(field);
        const double voxels = fields.weighed(label).volume;
        // A voxel's samples around it keep their labels, too: a body of one has less than .7.
        CHECK(volume > (label == 7 ? 0.5 : 0.1) * voxels);
        CHECK(volume < 1.25 * voxels);
      }
    }
  }
  // In a small ball, which has a weight itself.
  LabelFields fields = fields_of(ball(24, 4.2, {11, 12, 12}, 5), {0, {3, 3, 3}});
  CHECK(fields.weighed(3).weight > 1.2);
  CHECK(greatest(fields.field(5)) > 0);
  CHECK(inside_volume(fields.field(5)) > 0.1);
}

TEST_CASE("weights keep volumes that equal weights would not") {
  for (const double radius : {3.0, 6.0, 10.0}) {
    CAPTURE(radius);
    const Volume labels = ball(30, radius, {14.3, 15.1, 14.8}, 3);
    LabelFields fields = fields_of(labels, {0, {1, 1, 1}});
    const LabelSamples& three = fields.weighed(3);
    const Volume field = fields.field(3);
    CHECK(inside_volume(field, 3) == inside_volume(field));
    CHECK(inside_volume(field) == doctest::Approx(three.volume).epsilon(0.007));
    CHECK(fields.weighed(0).weight == 1);
    // Another count, of random points; with equal weights it is the indicator above one half. The
    // shift of a surface is sigma^2 over its radius.
    const std::vector<std::int64_t> one{3};
    const Volume smooth =
        gaussian(label_indicator(labels, one, {{0, 0, 0}, {29, 29, 29}}), {1, 1, 1});
    Random random(9);
    constexpr int kPoints = 400000;
    int above = 0, above_half = 0;
    for (int n = 0; n < kPoints; ++n) {
      const Vec3 p{random.uniform(0, 29), random.uniform(0, 29), random.uniform(0, 29)};
      const double value = smooth.value(p);
      above += three.weight * value >= 1 - value;
      above_half += value >= 0.5;
    }
    const double of_box = 29. * 29. * 29. / kPoints;
    CHECK(above * of_box == doctest::Approx(three.volume).epsilon(0.02));
    CHECK(above_half * of_box / three.volume - 1 ==
          doctest::Approx(-3 / (radius * radius)).epsilon(0.25));
  }
}

TEST_CASE("cells that fill a block keep their volumes, though few of them meet larger ones") {
  // The weights followed the tails of the Gaussians of cells that do not meet: .0006 to 1.2 here.
  Random random(4);
  constexpr int kSide = 30;
  std::vector<Vec3> centers(30);
  for (Vec3& c : centers) {
    for (int axis = 0; axis < 3; ++axis) c[axis] = random.uniform(0, kSide);
  }
  const Volume volume =
      sampled<std::uint8_t>({kSide, kSide, kSide}, {1, 1, 1}, [&](int i, int j, int k) {
        const Vec3 p{double(i), double(j), double(k)};
        const auto nearest =
            std::ranges::min_element(centers, {}, [&](const Vec3& c) { return distance2(c, p); });
        return static_cast<int>(nearest - centers.begin() + 1);
      });
  LabelFields fields = fields_of(volume, {0, {1, 1, 1}});
  for (const LabelSamples& l : fields.weighed()) {
    CAPTURE(l.label);
    CHECK(l.weight > 0.8);
    CHECK(l.weight < 2);
    CHECK(inside_volume(fields.field(l.label)) == doctest::Approx(l.volume).epsilon(0.05));
  }
}

namespace {

// Balls of different sizes, each with a label of its own; and the same as one mask.
constexpr Index3 kBalls{76, 24, 20};
int ball_at(int i, int j, int k) {
  constexpr double kRadius[] = {4.6, 3.1, 2.2, 1, 0.6}, kAt[] = {8.3, 27.2, 43.8, 58, 70.2};
  for (int n = 0; n < 5; ++n) {
    const double x = i - kAt[n], y = j - 11.2, z = k - 9.8;
    if (x * x + y * y + z * z <= kRadius[n] * kRadius[n]) return n + 1;
  }
  return 0;
}

// Returns the sample of a field that was cut out of a volume; -1 beyond.
double sample_of_all(const Volume& field, Index3 at) {
  const Vec3 first = field.frame().origin;
  const Index3 here{at.i - int(first.x), at.j - int(first.y), at.k - int(first.z)};
  const Index3 n = field.dims();
  const bool is_in =
      here.i >= 0 && here.i < n.i && here.j >= 0 && here.j < n.j && here.k >= 0 && here.k < n.k;
  return is_in ? field.sample(here.i, here.j, here.k) : -1;
}

}  // namespace

TEST_CASE("each body of a mask has the field that it would have as a label") {
  const Volume labels = sampled<std::uint8_t>(kBalls, {1, 1, 1}, ball_at);
  const Volume mask = sampled<std::uint8_t>(
      kBalls, {1, 1, 1}, [](int i, int j, int k) { return ball_at(i, j, k) > 0; });
  const IndicatorFilter filter{0, {1, 1, 1}};
  const Volume all = fields_of(mask, filter).field(1);
  LabelFields each = fields_of(labels, filter);
  for (const LabelSamples& l : each.weighed()) {
    if (l.label == 0) continue;
    CAPTURE(l.label);
    const Volume own = each.field(l.label);
    CHECK(greatest(own) > 0);
    if (l.samples >= 30) CHECK(inside_volume(own) == doctest::Approx(l.volume).epsilon(0.03));
    int wrong = 0;
    for_each_index(kBalls, [&](int i, int j, int k) {
      const double value = sample_of_all(own, {i, j, k});
      wrong += value > -0.9 && value != sample_of_all(all, {i, j, k});
    });
    CHECK(wrong == 0);
  }
}

TEST_CASE("bodies of one label do not take space from each other") {
  const Volume mask = sampled<std::uint8_t>({20, 11, 11}, {1, 1, 1}, [](int i, int j, int k) {
    const bool is_in = j > 2 && j < 8 && k > 2 && k < 8;
    return is_in && ((i > 2 && i < 8) || (i > 9 && i < 13));
  });
  LabelFields fields = fields_of(mask, {0, {1, 1, 1}});
  const Volume one = fields.field(1), zero = fields.field(0);
  for_each_index({20, 11, 11}, [&](int i, int j, int k) {
    const double value = sample_of_all(one, {i, j, k});
    if (value > -1) CHECK(value == -sample_of_all(zero, {i, j, k}));
  });
}

TEST_CASE("the volume inside a plane is exact, wherever the plane is") {
  for (const double at : {3.02, 3.37, 3.5, 3.81, 4.0}) {
    const Volume field = sampled<float>({8, 5, 4}, {1, 1, 1}, [&](int i, int j, int k) {
      return static_cast<float>(i - at) + 0.F * static_cast<float>(j * k);
    });
    CHECK(inside_volume(field) == doctest::Approx((7 - at) * 4 * 3).epsilon(1e-3));
  }
}

TEST_CASE("parts are bodies whose samples are neighbors by faces, edges or corners") {
  Random random(12);
  const Index3 n{9, 8, 7};
  const Volume volume = sampled<std::uint8_t>(
      n, {1, 1, 1}, [&](int, int, int) { return random.below(6) == 0 ? 1 + random.below(2) : 0; });
  const std::vector<LabelSamples> labels = find_labels(volume, "v");
  const LabelParts found = find_parts(volume, labels, {}, {0, 0, 0}, true, "v", 1);
  // Bodies by flooding from each sample.
  std::vector<int> body(volume.sample_count(), -1);
  int bodies = 0;
  for (std::size_t seed = 0; seed < body.size(); ++seed) {
    if (body[seed] >= 0) continue;
    std::vector<std::size_t> open{seed};
    body[seed] = bodies;
    while (!open.empty()) {
      const auto at = static_cast<int>(open.back());
      open.pop_back();
      const Index3 here{at % n.i, at / n.i % n.j, at / n.i / n.j};
      for_each_index({3, 3, 3}, [&](int i, int j, int k) {
        const Index3 to = here + Index3{i - 1, j - 1, k - 1};
        if (to.i < 0 || to.j < 0 || to.k < 0 || to.i >= n.i || to.j >= n.j || to.k >= n.k) return;
        const std::size_t next = volume.index(to.i, to.j, to.k);
        if (body[next] >= 0 ||
            volume.sample(to.i, to.j, to.k) != volume.sample(here.i, here.j, here.k)) {
          return;
        }
        body[next] = bodies;
        open.push_back(next);
      });
    }
    ++bodies;
  }
  // Samples of one body are in one part, and those of two are not but in a label's main part.
  std::vector<int> part_of(static_cast<std::size_t>(bodies), -1), body_of(found.parts.size(), -1);
  for_each_index({n.k, n.j, n.i}, [&](int k, int j, int i) {
    const auto part = static_cast<int>(found.part_at.sample(i, j, k));
    const int own = body[volume.index(i, j, k)];
    int& known = part_of[static_cast<std::size_t>(own)];
    CHECK((known == -1 || known == part));
    known = part;
    if (part < static_cast<int>(labels.size())) return;
    int& other = body_of[static_cast<std::size_t>(part)];
    CHECK((other == -1 || other == own));
    other = own;
  });
  CHECK(found.parts.size() > labels.size() + 5);
}

TEST_CASE("a label next to the box has the field that it has far from it") {
  const auto cube = [](int margin) {
    const int n = 6 + 2 * margin;
    return sampled<std::uint8_t>({n, n, n}, {1, 1, 1}, [&](int i, int j, int k) {
      const auto is_in = [&](int x) { return x >= margin && x < margin + 6; };
      return is_in(i) && is_in(j) && is_in(k);
    });
  };
  const IndicatorFilter filter{0, {1, 1, 1}};
  const Volume near = fields_of(cube(1), filter).field(1),
               far = fields_of(cube(9), filter).field(1);
  CHECK(inside_volume(near) == doctest::Approx(216).epsilon(0.01));
  for_each_index({8, 8, 8}, [&](int i, int j, int k) {
    CHECK(sample_of_all(near, {i, j, k}) == sample_of_all(far, {i + 8, j + 8, k + 8}));
  });
}

TEST_CASE("a mirrored volume has the mirrored fields, to the last bit") {
  const Volume volume = cells(11);
  const IndicatorFilter filter{0, {1, 0.8, 1.2}};
  LabelFields fields = fields_of(volume, filter);
  for (int axis = 0; axis < 3; ++axis) {
    const auto mirrored = [&](Index3 at) {
      at[axis] = kCells[axis] - 1 - at[axis];
      return at;
    };
    LabelFields others = fields_of(sampled<std::uint8_t>(kCells, {1, 1, 1},
                                                         [&](int i, int j, int k) {
                                                           const Index3 at = mirrored({i, j, k});
                                                           return volume.sample(at.i, at.j, at.k);
                                                         }),
                                   filter);
    for (const LabelSamples& l : fields.weighed()) {
      CAPTURE(l.label);
      CHECK(others.weighed(l.label).weight == l.weight);
      const Volume a = fields.field(l.label), b = others.field(l.label);
      int wrong = 0;
      for_each_index(kCells, [&](int i, int j, int k) {
        wrong += sample_of_all(a, {i, j, k}) != sample_of_all(b, mirrored({i, j, k}));
      });
      CHECK(wrong == 0);
    }
  }
}
