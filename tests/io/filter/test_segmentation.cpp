// SPDX-License-Identifier: MIT
#include "io/filter/segmentation.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"
#include "refusal.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

template <class T>
Volume random_labels(Index3 n, std::int64_t least, std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> samples(static_cast<std::size_t>(n.i * n.j * n.k));
  T last = static_cast<T>(least);
  for (T& s : samples) {
    if (random.below(3) == 0) last = static_cast<T>(least + random.below(count));
    s = last;
  }
  return Volume::from_samples(n, {1, 1, 1}, samples);
}

template <class T>
void hold_against_brute_force(Index3 n, std::int64_t least, std::uint32_t count) {
  const Volume volume = random_labels<T>(n, least, count, 5);
  const auto one = find_labels(volume, "v", 1), many = find_labels(volume, "v", 3);
  std::uint64_t all = 0;
  std::int64_t before = std::numeric_limits<std::int64_t>::min();
  REQUIRE(one.size() == many.size());
  for (std::size_t m = 0; m < one.size(); ++m) {
    const LabelSamples& found = one[m];
    CHECK(found.label > before);
    before = found.label;
    std::uint64_t samples = 0;
    double share = 0;
    Index3 first = n, last{-1, -1, -1};
    for_each_index(n, [&](int i, int j, int k) {
      if (volume.sample(i, j, k) != static_cast<double>(found.label)) return;
      ++samples;
      const auto half = [](int at, int of) { return at == 0 || at == of - 1 ? 0.5 : 1; };
      share += half(i, n.i) * half(j, n.j) * half(k, n.k);
      first = {std::min(first.i, i), std::min(first.j, j), std::min(first.k, k)};
      last = {std::max(last.i, i), std::max(last.j, j), std::max(last.k, k)};
    });
    all += samples;
    for (const LabelSamples& same : {found, many[m]}) {
      CHECK(same.label == found.label);
      CHECK(same.samples == samples);
      CHECK(same.volume == share);
      CHECK(same.box.begin == first);
      CHECK(same.box.end == last);
    }
  }
  CHECK(all == volume.sample_count());
  const SampleBox box{{2, 1, 3}, {n.i - 3, n.j - 1, n.k - 4}};
  std::uint64_t in_box = 0;
  for (const LabelSamples& found : find_labels(volume, "v", 2, box)) {
    in_box += found.samples;
    CHECK(is_in(found.box, box));
  }
  CHECK(in_box == static_cast<std::uint64_t>(box.dims().i * box.dims().j * box.dims().k));
}

std::string refusal(const Volume& volume) {
  return test::refusal_by([&] { find_labels(volume, "seg.npy", 2); });
}

// A ball of label 3 in a box of n^3 samples.
Volume ball(int n, double radius, const Vec3& center) {
  return sampled<std::uint8_t>({n, n, n}, {1, 1, 1}, [&](int i, int j, int k) {
    const Vec3 d = Vec3{double(i), double(j), double(k)} - center;
    return dot(d, d) <= radius * radius ? 3 : 0;
  });
}

}  // namespace

TEST_CASE("all labels are found, with their voxels and boxes, in all types") {
  const Index3 n{13, 7, 19};
  hold_against_brute_force<std::uint8_t>(n, 0, 6);
  hold_against_brute_force<std::int8_t>(n, -128, 5);
  hold_against_brute_force<std::uint16_t>(n, 65530, 6);
  hold_against_brute_force<std::int32_t>(n, -2147483648, 3);
  hold_against_brute_force<std::uint32_t>(n, 4294967290, 6);
  hold_against_brute_force<float>(n, -3, 7);
  hold_against_brute_force<double>(n, std::int64_t{1} << 52, 4);
}

TEST_CASE("samples that number ids have their labels") {
  Random random(4);
  std::vector<std::uint32_t> samples(60);
  for (std::uint32_t& s : samples) s = random.below(3);
  const Volume volume = Volume::from_samples({3, 4, 5}, {1, 1, 1}, samples);
  const std::vector<std::int64_t> ids{-5, 720575940621039145, 720575940621039146};
  const auto plain = find_labels(volume, "v", 2), named = find_labels({volume, ids}, "v", 2);
  REQUIRE(named.size() == 3);
  const SampleBox box{{0, 0, 0}, {2, 3, 4}};
  for (std::size_t n = 0; n < 3; ++n) {
    CHECK(named[n].label == ids[n]);
    CHECK(named[n].samples == plain[n].samples);
    const std::vector<std::int64_t> of_ids{ids[n], ids[0]}, of_numbers{plain[n].label, 0};
    const Volume a = label_indicator({volume, ids}, of_ids, box);
    const Volume b = label_indicator(volume, of_numbers, box);
    for_each_index({3, 4, 5},
                   [&](int i, int j, int k) { CHECK(a.sample(i, j, k) == b.sample(i, j, k)); });
  }
}

TEST_CASE("labels that are no whole numbers are refused, with their place") {
  for (const double bad : {1.5, 0x1p63, -1e300, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    std::vector<double> samples(4 * 4 * 24, 2);
    samples[static_cast<std::size_t>(1 + 4 * (2 + 4 * 9))] = bad;
    samples[static_cast<std::size_t>(3 + 4 * (2 + 4 * 21))] = 0.25;  // in a later task
    const std::string message = refusal(Volume::from_samples({4, 4, 24}, {1, 1, 1}, samples));
    CHECK(message.starts_with("seg.npy: the sample at (1, 2, 9) is "));
  }
  CHECK(refusal(random_labels<float>({4, 4, 4}, -2, 5, 1)).empty());
}

TEST_CASE("a label that is not there is refused, with those that are") {
  const Volume volume = random_labels<std::uint8_t>({6, 6, 6}, 2, 3, 1);
  const auto found = find_labels(volume, "v");
  const std::vector<std::int64_t> both{2, 4}, absent{2, 7};
  const LabelSamples all = united_labels(found, both, "v");
  CHECK(all.samples == found[0].samples + found[2].samples);
  CHECK_THROWS_WITH_AS(united_labels(found, absent, "v"),
                       "v: no sample has label 7: its 3 labels are 2, 3, 4", InputError);
}

TEST_CASE("filters of the cut-out indicator give what filters of all of it give") {
  // In a corner of the box, so that some margins are cut off.
  const Volume volume = ball(40, 9, {8, 20.3, 29});
  const std::vector<std::int64_t> labels{3};
  const LabelSamples extent = united_labels(find_labels(volume, "v"), labels, "v");
  const SampleBox everything{{0, 0, 0}, {39, 39, 39}};
  const Volume whole =
      gaussian(median(label_indicator(volume, labels, everything), 2), {1.5, 1, 0.7});
  const Index3 margin{gaussian_radius(1.5) + 3, gaussian_radius(1) + 3, gaussian_radius(0.7) + 3};
  const SampleBox box = grown(extent.box, margin, everything.end);
  const Volume cut = gaussian(median(label_indicator(volume, labels, box, 2), 2), {1.5, 1, 0.7});
  CHECK(cut.sample_count() < whole.sample_count());
  const Vec3 at = cut.frame().origin;
  CHECK(at.x == 0);  // there is no room for a margin
  CHECK(at.y == 12 - margin.j);
  const Index3 n = cut.dims();
  double inside = 0, all = 0;
  int wrong = 0;
  for_each_index(n, [&](int i, int j, int k) {
    const double value = cut.sample(i, j, k);
    inside += value;
    wrong += value != whole.sample(i + int(at.x), j + int(at.y), k + int(at.z));
  });
  whole.visit([&](const auto* s) {
    for (std::size_t m = 0; m < whole.sample_count(); ++m) all += static_cast<double>(s[m]);
  });
  CHECK(wrong == 0);
  CHECK(inside == doctest::Approx(all).epsilon(1e-12));  // 0 beyond the cut
}
