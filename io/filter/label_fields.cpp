// SPDX-License-Identifier: MIT
#include "io/filter/label_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>

#include "base/check.h"
#include "base/parallel.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"

namespace deliso {
namespace {

constexpr std::size_t kSlicesOfSum = 8;
constexpr double kLargestWeight = 1e9;  // a Gaussian of kLargestSigma spreads a voxel over 1.6e7
constexpr float kLeastRival = 1e-30F;   // less than any weighted indicator
constexpr std::size_t kManyParts = 8;   // then the labels that they ask for are smoothed once
constexpr int kMostMargin = 16;         // samples beyond the box; those further on are reflected

// The points of a voxel at which a field is measured: 16 in an octant, and their mirror images.
// Along each axis they have 32 places (Korobov 1959): surfaces of labels are often in planes of the
// grid, where 5 x 5 x 5 points have 5. Each row has the points' shares of a corner, which have 18
// bits.
constexpr int kPointsOfOctant = 16, kPointsOfVoxel = 8 * kPointsOfOctant;
using Points = std::array<float, kPointsOfVoxel>;
constexpr auto kShares = [] {
  std::array<Points, 8> shares{};
  for (int n = 0; n < kPointsOfVoxel; ++n) {
    const auto at = [n](int step, int axis) {
      const double x = ((n >> 3) * step % kPointsOfOctant + 0.5) / (2 * kPointsOfOctant);
      return (n >> axis & 1) != 0 ? 1 - x : x;
    };
    const std::array<double, 3> p{at(3, 0), at(5, 1), at(7, 2)};
    for (int m = 0; m < 8; ++m) {
      double share = 1;
      for (int axis = 0; axis < 3; ++axis) share *= (m >> axis & 1) != 0 ? p[axis] : 1 - p[axis];
      shares[m][n] = static_cast<float>(share);
    }
  }
  return shares;
}();

// Opposite corners first: so a mirrored voxel has the same sums.
Points values_at_points(const Corners& corners) {
  std::array<float, 8> c;
  std::ranges::transform(corners, c.begin(), [](double at) { return static_cast<float>(at); });
  const auto& s = kShares;
  Points values;
  for (int n = 0; n < kPointsOfVoxel; ++n) {
    values[n] = ((s[0][n] * c[0] + s[7][n] * c[7]) + (s[1][n] * c[1] + s[6][n] * c[6])) +
                ((s[2][n] * c[2] + s[5][n] * c[5]) + (s[3][n] * c[3] + s[4][n] * c[4]));
  }
  return values;
}

Volume volume_of(std::vector<float> samples, const Grid& like) {
  const auto owner = std::make_shared<const std::vector<float>>(std::move(samples));
  return {like.of_type(SampleType::f32), reinterpret_cast<const std::byte*>(owner->data()), owner};
}

SampleBox common(const SampleBox& a, const SampleBox& b) {
  SampleBox c;
  for (int axis = 0; axis < 3; ++axis) {
    c.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
    c.end[axis] = std::max(c.begin[axis] - 1, std::min(a.end[axis], b.end[axis]));
  }
  return c;
}
bool is_empty(const SampleBox& box) {
  return box.dims().i == 0 || box.dims().j == 0 || box.dims().k == 0;
}

// Calls f(begin in a, begin in b, length) for the rows of samples that two boxes have in common.
// They are numbered in each box.
template <class F>
void for_each_row(const SampleBox& a, const SampleBox& b, int threads, F&& f) {
  const SampleBox both = common(a, b);
  const Index3 n = both.dims();
  const auto number = [&](const SampleBox& in, int j, int k) {
    const Index3 dims = in.dims();
    return static_cast<std::size_t>(both.begin.i - in.begin.i) +
           static_cast<std::size_t>(dims.i) *
               (static_cast<std::size_t>(j - in.begin.j) +
                static_cast<std::size_t>(dims.j) * static_cast<std::size_t>(k - in.begin.k));
  };
  for_each_task(threads, static_cast<std::size_t>(n.k), [&](std::size_t slice) {
    const int k = both.begin.k + static_cast<int>(slice);
    for (int j = both.begin.j; j <= both.end.j; ++j) {
      f(number(a, j, k), number(b, j, k), static_cast<std::size_t>(n.i));
    }
  });
}

// Makes one label, named by the first, of those in `united`.
std::vector<LabelSamples> as_one(std::vector<LabelSamples> labels,
                                 std::span<const std::int64_t> united, std::string_view name) {
  if (united.empty()) return labels;
  const LabelSamples one = united_labels(labels, united, name);
  std::erase_if(labels, [&](const LabelSamples& l) {
    return l.label != one.label && std::ranges::find(united, l.label) != united.end();
  });
  *std::ranges::find(labels, one.label, &LabelSamples::label) = one;
  return labels;
}

Index3 reach_of(const IndicatorFilter& filter) {
  Index3 reach;
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] = gaussian_radius(filter.sigma[axis]) + filter.median;
  }
  return reach;
}
Index3 margin_of(Index3 reach) {
  for (int axis = 0; axis < 3; ++axis) reach[axis] = std::min(reach[axis] + 1, kMostMargin);
  return reach;
}

// A weight, rounded: so sums in another order give the same.
double rounded_weight(double weight) {
  int exponent = 0;
  const double share = std::frexp(weight, &exponent);
  return std::ldexp(std::round(std::ldexp(share, 16)), exponent - 16);
}

// Calls f(slice's number, partial sum) for all slices of voxels, and returns the sums of runs of
// slices, in their order.
template <class Sum, class F>
std::vector<Sum> sum_slices(const Volume& volume, int threads, F&& f) {
  const auto slices = static_cast<std::size_t>(std::max(0, volume.voxels().k));
  std::vector<Sum> sums(runs_of(slices, kSlicesOfSum));
  for_each_run(threads, slices, kSlicesOfSum,
               [&](std::size_t run, std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k) f(static_cast<int>(k), sums[run]);
               });
  return sums;
}

}  // namespace

// In the box of a part: its s, the largest w_M s_M of others, and the sum of their s_M.
struct LabelFields::Rivals {
  Volume own, largest, sum;
};

namespace {

// Shares of points in bins of u = s / (s + O), where O is the largest of the others. Raising the
// weight moves L's border from u = 1 to u = 0.
constexpr int kBins = 4096;
constexpr double kNegligible = 1e-3;  // share of the greatest u, or of 1 - u
struct Shares {
  std::vector<double> of_bin = std::vector<double>(kBins);  // s, and the larger labels' share
  double own = 0;                                           // s
};

double level_of(const Corners& own, const Corners& others, int m) {
  return own[m] > 0 ? own[m] / (own[m] + others[m]) : 0;
}

// The greatest u of a sample.
double greatest_level(const Volume& own, const Volume& others) {
  double greatest = 0;
  own.visit([&](const auto* s) {
    others.visit([&](const auto* o) {
      for (std::size_t n = 0; n < own.sample_count(); ++n) {
        const double s_n = static_cast<double>(s[n]), o_n = static_cast<double>(o[n]);
        if (s_n > 0) greatest = std::max(greatest, s_n / (s_n + o_n));
      }
    });
  });
  return greatest;
}

void add_slice(const Volume& own, const Volume& others, const Volume& mass, double greatest, int k,
               Shares& shares) {
  const Index3 voxels = own.voxels();
  const auto scale = static_cast<float>(kBins / greatest);
  for (int j = 0; j < voxels.j; ++j) {
    for (int i = 0; i < voxels.i; ++i) {
      const Corners s = own.corners({i, j, k}), o = others.corners({i, j, k});
      double least = 1, most = 0;
      for (int m = 0; m < 8; ++m) {
        const double u = level_of(s, o, m);
        least = std::min(least, u);
        most = std::max(most, u);
      }
      if (most < kNegligible * greatest || least > 1 - kNegligible) continue;
      const double voxel = own.share_of({i, j, k});
      const Points own_at = values_at_points(s), others_at = values_at_points(o),
                   mass_at = values_at_points(mass.corners({i, j, k}));
      std::array<int, kPointsOfVoxel> bin;
      for (int n = 0; n < kPointsOfVoxel; ++n) {
        const float both = std::max(own_at[n] + others_at[n], kLeastRival);
        bin[n] = std::min(static_cast<int>(scale * (own_at[n] / both)), kBins - 1);
      }
      for (int n = 0; n < kPointsOfVoxel; ++n) {
        const double s_n = own_at[n];
        shares.of_bin[bin[n]] += voxel * (s_n + mass_at[n]);
        shares.own += voxel * s_n;
      }
    }
  }
}

// Returns the weight of a label at which its points hold as much of the others as others' points
// hold of it: the integral of s_L + r over {w s_L >= O} is that of s_L.
double balanced_weight(const Volume& own, const Volume& others, const Volume& mass, int threads) {
  const double greatest = greatest_level(own, others);
  if (!(greatest > 0)) return 1;  // a median has removed it
  Shares all;
  for (const Shares& part : sum_slices<Shares>(own, threads, [&](int k, Shares&shares) {
         add_slice(own, others, mass, greatest, k, shares);
       })) {
    all.own += part.own;
    for (int n = 0; n < kBins; ++n) all.of_bin[n] += part.of_bin[n];
  }
  if (!(all.own > 0)) return 1;  // it meets no larger label
  // From above, bin by bin. The shares of one are spread evenly between it and the next ones that
  // are not empty: along the grid's axes u has few values.
  double above = 0;
  int last = kBins - 1, here = 0;
  for (int n = kBins; n-- > 0;) {
    if (!(all.of_bin[n] > 0)) continue;
    here = n;
    if (above + all.of_bin[n] >= all.own) break;
    above += all.of_bin[n];
    last = n;
  }
  int next = here;
  while (next > 0 && !(all.of_bin[--next] > 0)) {
  }
  const double share = std::clamp((all.own - above) / all.of_bin[here], 0.0, 1.0);
  const double twice = (1 - share) * (last + here) + share * (next + here);
  const double level = (twice + 1) / 2 * greatest / kBins;
  return rounded_weight(std::clamp((1 - level) / level, 1 / kLargestWeight, kLargestWeight));
}

}  // namespace

LabelFields::LabelFields(const Segmentation& samples, std::vector<LabelSamples> found,
                         std::span<const std::int64_t> united, const IndicatorFilter& filter,
                         std::string_view name, int threads)
    : grid_(samples.volume),
      labels_(as_one(std::move(found), united, name)),
      united_(united.begin(), united.end()),
      filter_(filter),
      reach_(reach_of(filter)),
      name_(name),
      threads_(threads),
      parts_(find_parts(samples, labels_, united_, margin_of(reach_), filter.median == 0, name,
                        threads)),
      of_label_(labels_.size()) {}

std::size_t LabelFields::number_of(std::int64_t label) const {
  const bool is_united = std::ranges::find(united_, label) != united_.end();
  const auto at = std::ranges::lower_bound(labels_, is_united ? united_.front() : label, {},
                                           &LabelSamples::label);
  DELISO_CHECK(at != labels_.end());
  return static_cast<std::size_t>(at - labels_.begin());
}

std::vector<std::size_t> LabelFields::parts_of(std::size_t label) const {
  std::vector<std::size_t> parts;
  for (std::size_t part = 0; part < parts_.label_of.size(); ++part) {
    if (parts_.label_of[part] == label) parts.push_back(part);
  }
  return parts;
}

// Return the box of samples within the filter's reach, and one more: beyond it the smoothed
// indicator is 0.
SampleBox LabelFields::box(const LabelSamples& of) const {
  return grown(of.box);
}
SampleBox LabelFields::grown(const SampleBox& box) const {
  return deliso::grown(box, reach_ + Index3{1, 1, 1}, parts_.part_at.voxels());
}

// Returns a box of the volume's samples in the larger box of the parts.
SampleBox LabelFields::in_larger(const SampleBox& box) const {
  return {box.begin + parts_.margin, box.end + parts_.margin};
}

// Returns the samples of the volume that the field of a label reaches.
SampleBox LabelFields::box_of_label(std::size_t label) const {
  return deliso::grown(labels_[label].box, reach_ + Index3{1, 1, 1}, grid_.voxels());
}

// Returns the smoothed indicator of the samples of a number; within the reach of the box's inner
// faces it is wrong.
Volume LabelFields::smoothed(const Volume& numbers, std::size_t number, const SampleBox& box,
                             int threads) const {
  const auto one = static_cast<std::int64_t>(number);
  Volume field = label_indicator(numbers, std::span(&one, 1), box, threads);
  if (filter_.median > 0) field = median(field, filter_.median, threads);
  return gaussian(field, filter_.sigma, threads);
}

// Returns the labels from which a filter reaches the box.
std::vector<std::size_t> LabelFields::labels_near(const SampleBox& box) const {
  std::vector<std::size_t> numbers;
  for (const LabelSamples& l : find_labels(parts_.label_at, name_, 1, grown(box))) {
    numbers.push_back(static_cast<std::size_t>(l.label));
  }
  return numbers;
}

// The others are whole labels, with the weights of their main parts: all, or the larger ones.
LabelFields::Rivals LabelFields::rivals(std::size_t part, bool is_larger_only, int threads) const {
  const std::size_t label = parts_.label_of[part];
  const SampleBox own_box = box(parts_.parts[part]), reached = grown(own_box);
  Volume own = smoothed(parts_.part_at, part, own_box, threads);
  std::vector<float> largest(own.sample_count());
  std::vector<double> sum(own.sample_count());
  for (const std::size_t other : labels_near(own_box)) {
    if (other == label || (is_larger_only && !is_larger(other, label))) continue;
    const std::optional<Volume>& all = of_label_[other];
    const SampleBox whole = box(parts_.labels[other]), from = all ? whole : common(reached, whole);
    if (is_empty(common(from, own_box))) continue;
    const Volume s = all ? *all : smoothed(parts_.label_at, other, from, threads);
    const double weight = parts_.parts[other].weight;
    s.visit([&](const auto* values) {
      for_each_row(from, own_box, threads, [&](std::size_t in, std::size_t to, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
          const auto value = static_cast<double>(values[in + i]);
          largest[to + i] = std::max(largest[to + i], static_cast<float>(weight * value));
          sum[to + i] += value;
        }
      });
    });
  }
  Volume most = volume_of(std::move(largest), own);
  Volume mass = volume_of({sum.begin(), sum.end()}, own);
  return {std::move(own), std::move(most), std::move(mass)};
}

// The order in which labels get their weights: those of one size at once.
bool LabelFields::is_larger(std::size_t m, std::size_t n) const {
  return parts_.labels[m].samples > parts_.labels[n].samples;
}

// Gives weights to the main parts of the wanted labels.
void LabelFields::weigh(std::vector<std::uint8_t> wanted) {
  std::vector<std::size_t> order(labels_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return is_larger(a, b); });
  for (const std::size_t n : order) {
    if (!is_larger(order[0], n)) parts_.parts[n].weight = 1;
  }
  // From the smallest: a weight depends on those of larger labels near.
  for (std::size_t rank = order.size(); rank-- > 1;) {
    const std::size_t n = order[rank];
    if (wanted[n] == 0 || parts_.parts[n].weight > 0) continue;
    for (const std::size_t m : labels_near(box(parts_.labels[n]))) {
      if (is_larger(m, n)) wanted[m] = 1;
    }
  }
  for (const std::size_t n : order) {
    if (wanted[n] == 0 || parts_.parts[n].weight > 0) continue;
    const Rivals of = rivals(n, true, threads_);
    parts_.parts[n].weight = balanced_weight(of.own, of.largest, of.sum, threads_);
  }
  for (std::size_t n = 0; n < labels_.size(); ++n) labels_[n].weight = parts_.parts[n].weight;
}

// Gives weights to all parts of a label.
void LabelFields::weigh_parts(std::size_t label) {
  std::vector<std::uint8_t> wanted(labels_.size());
  wanted[label] = 1;
  std::vector<std::size_t> parts = parts_of(label), near;
  if (parts.size() > 1) near = labels_near(box(parts_.labels[label]));
  for (const std::size_t m : near) wanted[m] = 1;
  weigh(std::move(wanted));
  std::erase_if(parts, [&](std::size_t part) { return parts_.parts[part].weight > 0; });
  // Of many parts all ask for the same labels.
  for (const std::size_t m : near) {
    if (parts.size() <= kManyParts || m == label || of_label_[m]) continue;
    of_label_[m] = smoothed(parts_.label_at, m, box(parts_.labels[m]), threads_);
  }
  for_each_task(threads_, parts.size(), [&](std::size_t n) {
    const Rivals of = rivals(parts[n], false, 1);
    parts_.parts[parts[n]].weight = balanced_weight(of.own, of.largest, of.sum, 1);
  });
}

const std::vector<LabelSamples>& LabelFields::weighed() {
  weigh(std::vector<std::uint8_t>(labels_.size(), 1));
  return labels_;
}

const LabelSamples& LabelFields::weighed(std::int64_t label) {
  const std::size_t n = number_of(label);
  std::vector<std::uint8_t> wanted(labels_.size());
  wanted[n] = 1;
  weigh(std::move(wanted));
  return labels_[n];
}

// Raises values in a box of the volume to w_L s_L of a label.
void LabelFields::raise_to(std::size_t label, const SampleBox& box_of_values,
                           std::vector<float>& values) const {
  const SampleBox to = in_larger(box_of_values);
  for (const std::size_t part : parts_of(label)) {
    const SampleBox from = common(grown(to), box(parts_.parts[part]));
    if (is_empty(common(from, to))) continue;
    const int threads = part < labels_.size() ? threads_ : 1;
    const Volume s = smoothed(parts_.part_at, part, from, threads);
    const double weight = parts_.parts[part].weight;
    s.visit([&](const auto* row) {
      for_each_row(from, to, threads, [&](std::size_t in, std::size_t out, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
          const auto value = static_cast<float>(weight * static_cast<double>(row[in + i]));
          values[out + i] = std::max(values[out + i], value);
        }
      });
    });
  }
}

Volume LabelFields::field(std::int64_t label) {
  const std::size_t l = number_of(label);
  const SampleBox within = box_of_label(l);
  const Grid block = grid_.cropped(within.begin, within.dims()).of_type(SampleType::f32);
  std::vector<float> own(block.sample_count()), others(block.sample_count(), kLeastRival);
  for (const std::size_t m : labels_near(box(parts_.labels[l]))) {
    weigh_parts(m);
    raise_to(m, within, m == l ? own : others);
  }
  parts_.label_at.visit([&](const auto* number) {
    for_each_row({{}, parts_.label_at.voxels()}, in_larger(within), threads_,
                 [&](std::size_t from, std::size_t to, std::size_t n) {
                   for (std::size_t i = 0; i < n; ++i) {
                     // A median may leave a sample to no label: it is outside.
                     float& value = own[to + i];
                     const float other = others[to + i], ahead = value - other;
                     value = filter_.median > 0 ? ahead
                             : static_cast<std::size_t>(number[from + i]) == l
                                 ? std::max(ahead, kAhead * other)
                                 : std::min(ahead, -kAhead * value);
                   }
                 });
  });
  return Volume::from_samples(block, own);
}

Volume LabelFields::weighted(std::int64_t label) {
  const std::size_t l = number_of(label);
  weigh_parts(l);
  const SampleBox within = box_of_label(l);
  const Grid block = grid_.part(within.begin, within.dims()).of_type(SampleType::f32);
  std::vector<float> samples(block.sample_count());
  raise_to(l, within, samples);
  return Volume::from_samples(block, samples);
}

std::vector<std::uint32_t> LabelFields::kept() const {
  std::vector<std::uint32_t> label;
  if (filter_.median > 0) return label;
  label.resize(grid_.sample_count());
  parts_.label_at.visit([&](const auto* number) {
    for_each_row({{}, parts_.label_at.voxels()}, in_larger({{}, grid_.voxels()}), threads_,
                 [&](std::size_t from, std::size_t to, std::size_t n) {
                   std::copy_n(number + from, n, &label[to]);
                 });
  });
  return label;
}

double inside_volume(const Volume& field, int threads) {
  double points = 0;
  for (const double part : sum_slices<double>(field, threads, [&](int k, double&sum) {
         for (int j = 0; j < field.voxels().j; ++j) {
           for (int i = 0; i < field.voxels().i; ++i) {
             const Corners c = field.corners({i, j, k});
             const auto [least, most] = std::ranges::minmax(c);
             // Near the surface a point counts in part: it stands for a 32nd along each axis.
             double inside = least >= 0 ? kPointsOfVoxel : 0;
             if (least < 0 && most >= 0) {
               const double scale = 2 * kPointsOfOctant / (most - least);
               for (const float value : values_at_points(c)) {
                 inside += std::clamp(0.5 + scale * static_cast<double>(value), 0.0, 1.0);
               }
             }
             sum += inside * field.share_of({i, j, k});
           }
         }
       })) {
    points += part;
  }
  return points / kPointsOfVoxel;
}

}  // namespace deliso
