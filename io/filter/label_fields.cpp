// SPDX-License-Identifier: MIT
#include "io/filter/label_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/check.h"
#include "base/elementary.h"
#include "base/parallel.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"

namespace deliso {
namespace {

constexpr std::size_t kSlicesOfSum = 8;
constexpr double kLargestWeight = 1e9;  // a Gaussian of kLargestSigma spreads a voxel over 1.6e7
constexpr float kLeastRival = 1e-30F;   // less than any weighted indicator
constexpr int kMostMargin = 16;         // samples beyond the box; those further on are reflected

// The points of a voxel at which a field is measured: 16 in an octant, and their mirror images.
// Along each axis they have 32 places (Korobov 1959): surfaces of labels are often in planes of the
// grid, where 5 x 5 x 5 points have 5. Each row has the shares of the eight corners.
constexpr int kPointsOfOctant = 16, kPointsOfVoxel = 8 * kPointsOfOctant;
constexpr auto kShares = [] {
  std::array<std::array<double, 8>, kPointsOfVoxel> shares{};
  for (int n = 0; n < kPointsOfVoxel; ++n) {
    const auto at = [n](int step, int axis) {
      const double x = ((n >> 3) * step % kPointsOfOctant + 0.5) / (2 * kPointsOfOctant);
      return (n >> axis & 1) != 0 ? 1 - x : x;
    };
    const std::array<double, 3> p{at(3, 0), at(5, 1), at(7, 2)};
    for (int m = 0; m < 8; ++m) {
      double share = 1;
      for (int axis = 0; axis < 3; ++axis) share *= (m >> axis & 1) != 0 ? p[axis] : 1 - p[axis];
      shares[n][m] = share;
    }
  }
  return shares;
}();

// The same sum in a mirrored voxel.
double value_at(const Corners& c, int point) {
  const std::array<double, 8>& share = kShares[point];
  const auto opposite = [&](int m) { return share[m] * c[m] + share[7 - m] * c[7 - m]; };
  return (opposite(0) + opposite(1)) + (opposite(2) + opposite(3));
}

Volume volume_of(std::vector<float> samples, const Grid& like) {
  const auto owner = std::make_shared<const std::vector<float>>(std::move(samples));
  return {like.of_type(SampleType::f32), reinterpret_cast<const std::byte*>(owner->data()), owner};
}

SampleExtent common(const SampleExtent& a, const SampleExtent& b) {
  SampleExtent c;
  for (int axis = 0; axis < 3; ++axis) {
    c.first[axis] = std::max(a.first[axis], b.first[axis]);
    c.last[axis] = std::min(a.last[axis], b.last[axis]);
  }
  return c;
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

// Of a label L in its box: s_L, the largest w_M s_M of the others, and the sum of their s_M.
struct LabelFields::Rivals {
  SampleExtent box;
  Volume own;
  Volume largest, sum;
};

namespace {

// Shares of points in bins of u = s / (s + O), where O is the largest of the others. Raising the
// weight moves L's border from u = 1 to u = 0.
constexpr std::size_t kBins = 4096;
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
      const Corners r = mass.corners({i, j, k});
      const double voxel = own.share_of({i, j, k});
      for (int n = 0; n < kPointsOfVoxel; ++n) {
        const double s_n = value_at(s, n), o_n = value_at(o, n);
        if (!(s_n + o_n > 0)) continue;
        const double u = s_n / (s_n + o_n);
        const auto bin = std::min(static_cast<std::size_t>(kBins * (u / greatest)), kBins - 1);
        shares.of_bin[bin] += voxel * (s_n + value_at(r, n));
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
    for (std::size_t n = 0; n < kBins; ++n) all.of_bin[n] += part.of_bin[n];
  }
  if (!(all.own > 0)) return 1;  // it meets no larger label
  // From above, bin by bin. The shares of one are spread evenly between it and the next ones that
  // are not empty: along the grid's axes u has few values.
  double above = 0;
  std::size_t last = kBins - 1, here = 0;
  for (std::size_t n = kBins; n-- > 0;) {
    if (!(all.of_bin[n] > 0)) continue;
    here = n;
    if (above + all.of_bin[n] >= all.own) break;
    above += all.of_bin[n];
    last = n;
  }
  std::size_t next = here;
  while (next > 0 && !(all.of_bin[--next] > 0)) {
  }
  const double share = std::clamp((all.own - above) / all.of_bin[here], 0.0, 1.0);
  const double twice =
      (1 - share) * static_cast<double>(last + here) + share * static_cast<double>(next + here);
  const double level = (twice + 1) / 2 * greatest / kBins;
  return std::clamp((1 - level) / level, 1 / kLargestWeight, kLargestWeight);
}

// A label that has less than this share of its border with larger ones is weighed against all. With
// the tails of the Gaussians of two labels that hardly meet, cells that fill a block had weights
// from .0002 to 1.1 and volumes off by up to 44 %; now from .97 to 1.4 and 1.8 %. Shares of .05 to
// .4 did the same on 60 cells of 48^3 samples and 191 of 64^3.
constexpr double kFewLarger = 0.05;

// Returns how much of a label's border is with others, whose indicators have this sum.
double share_of_border(const Volume& own, const Volume& sum) {
  double shared = 0, border = 0;
  own.visit([&](const auto* s) {
    sum.visit([&](const auto* others) {
      for (std::size_t n = 0; n < own.sample_count(); ++n) {
        const double s_n = static_cast<double>(s[n]);
        shared += s_n * static_cast<double>(others[n]);
        border += s_n * (1 - s_n);
      }
    });
  });
  return border > 0 ? shared / border : 1;
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
      parts_(find_parts(samples, labels_, united_, margin_of(reach_), name, threads)) {}

std::size_t LabelFields::index_of(std::int64_t label) const {
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

// The order in which parts get their weights: those of one size at once.
bool LabelFields::is_larger(std::size_t m, std::size_t n) const {
  return parts_.parts[m].samples > parts_.parts[n].samples;
}

// Returns the box of samples within this number of reaches, and one more. Beyond one reach and one
// sample the smoothed indicator is 0.
SampleExtent LabelFields::box(const LabelSamples& of, int times) const {
  SampleExtent box;
  for (int axis = 0; axis < 3; ++axis) {
    const int margin = times * reach_[axis] + 1;
    box.first[axis] = std::max(0, of.first[axis] - margin);
    box.last[axis] = std::min(parts_.of_sample.dims()[axis] - 1, of.last[axis] + margin);
  }
  return box;
}

// Returns the smoothed indicator of a part; within the reach of the box's inner faces it is wrong.
Volume LabelFields::smoothed(std::size_t part, const SampleExtent& box) const {
  const auto number = static_cast<std::int64_t>(part);
  Volume field = label_indicator(parts_.of_sample, std::span(&number, 1), box, threads_);
  if (filter_.median > 0) field = median(field, filter_.median, threads_);
  return gaussian(field, filter_.sigma, threads_);
}

// Returns the samples of all parts from which a filter reaches the box of one.
std::vector<LabelSamples> LabelFields::near(std::size_t part) const {
  return find_labels(parts_.of_sample, name_, threads_, box(parts_.parts[part], 2));
}

LabelFields::Rivals LabelFields::rivals(std::size_t n, Others others) const {
  const SampleExtent own_box = box(parts_.parts[n], 1), reached = box(parts_.parts[n], 2);
  Volume own = smoothed(n, own_box);
  std::vector<float> largest(own.sample_count());
  std::vector<double> sum(others == Others::all ? 0 : own.sample_count());
  for (const LabelSamples& other : near(n)) {
    const auto m = static_cast<std::size_t>(other.label);
    if (parts_.label_of[m] == parts_.label_of[n]) continue;
    if (others == Others::larger && !is_larger(m, n)) continue;
    const SampleExtent from = common(reached, box(other, 1)), both = common(from, own_box);
    if (both.dims().i <= 0 || both.dims().j <= 0 || both.dims().k <= 0) continue;
    const Volume s = smoothed(m, from);
    const bool is_guess = others == Others::guessed && !is_larger(m, n);
    const double weight = is_guess ? weight_of_ball(m) : parts_.parts[m].weight;
    s.visit([&](const auto* values) {
      for_each_task(threads_, static_cast<std::size_t>(both.dims().k), [&](std::size_t slice) {
        const int k = both.first.k + static_cast<int>(slice);
        for (int j = both.first.j; j <= both.last.j; ++j) {
          const auto* row =
              values + s.index(both.first.i - from.first.i, j - from.first.j, k - from.first.k);
          const std::size_t at =
              own.index(both.first.i - own_box.first.i, j - own_box.first.j, k - own_box.first.k);
          for (std::size_t i = 0; i < static_cast<std::size_t>(both.dims().i); ++i) {
            const auto weighted = static_cast<float>(weight * static_cast<double>(row[i]));
            largest[at + i] = std::max(largest[at + i], weighted);
            if (!sum.empty()) sum[at + i] += static_cast<double>(row[i]);
          }
        }
      });
    });
  }
  Volume most = volume_of(std::move(largest), own);
  Volume mass = sum.empty() ? most : volume_of({sum.begin(), sum.end()}, own);
  return {own_box, std::move(own), std::move(most), std::move(mass)};
}

// Returns the weight at which a ball with the samples of a part keeps its volume, to first order:
// a Gaussian lowers the indicator at the surface of a ball of radius R by sigma / (R sqrt(2 pi)).
double LabelFields::weight_of_ball(std::size_t part) const {
  const double ball = 3 * static_cast<double>(parts_.parts[part].samples) / (4 * std::numbers::pi);
  const Vec3& sigma = filter_.sigma;
  const double curvature = cube_root(sigma.x * sigma.y * sigma.z / ball);
  return 1 + 4 / std::sqrt(2 * std::numbers::pi) * curvature;
}

// Gives weights to the wanted parts.
void LabelFields::weigh(std::vector<std::uint8_t> wanted) {
  std::vector<LabelSamples>& parts = parts_.parts;
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return is_larger(a, b); });
  for (const std::size_t n : order) {
    if (!is_larger(order[0], n)) parts[n].weight = 1;
  }
  // From the smallest: a part's weight depends on those of larger ones near it.
  for (std::size_t rank = order.size(); rank-- > 1;) {
    const std::size_t n = order[rank];
    if (wanted[n] == 0 || parts[n].weight > 0) continue;
    for (const LabelSamples& other : near(n)) {
      const auto m = static_cast<std::size_t>(other.label);
      if (is_larger(m, n)) wanted[m] = 1;
    }
  }
  for (const std::size_t n : order) {
    if (wanted[n] == 0 || parts[n].weight > 0) continue;
    Rivals of = rivals(n, Others::larger);
    if (share_of_border(of.own, of.sum) < kFewLarger) of = rivals(n, Others::guessed);
    parts[n].weight = rounded_weight(balanced_weight(of.own, of.largest, of.sum, threads_));
  }
  for (std::size_t n = 0; n < labels_.size(); ++n) labels_[n].weight = parts[n].weight;
}

const std::vector<LabelSamples>& LabelFields::weighed() {
  weigh(std::vector<std::uint8_t>(parts_.parts.size(), 1));
  return labels_;
}

const LabelSamples& LabelFields::weighed(std::int64_t label) {
  const std::size_t n = index_of(label);
  std::vector<std::uint8_t> wanted(parts_.parts.size());
  for (const std::size_t part : parts_of(n)) wanted[part] = 1;
  weigh(std::move(wanted));
  return labels_[n];
}

// Returns the samples around all parts of a label that their fields reach.
SampleExtent LabelFields::box_of_label(std::size_t label) const {
  SampleExtent all;
  for (int axis = 0; axis < 3; ++axis) {
    const int margin = reach_[axis] + 1;
    all.first[axis] = std::max(0, labels_[label].first[axis] - margin);
    all.last[axis] = std::min(grid_.dims()[axis] - 1, labels_[label].last[axis] + margin);
  }
  return all;
}

// Returns the largest value of all parts of a label in a box of the volume; `none` beyond their
// boxes. value(part) has those in the part's box.
template <class Value>
std::vector<float> LabelFields::largest_of_parts(std::size_t label, const SampleExtent& within,
                                                 float none, Value&& value) const {
  constexpr float kNone = std::numeric_limits<float>::lowest();
  const Index3 n = within.dims();
  std::vector<float> largest(std::size_t(n.i) * n.j * n.k, kNone);
  for (const std::size_t part : parts_of(label)) {
    const Volume values = value(part);
    const SampleExtent from = box(parts_.parts[part], 1);
    const SampleExtent both =
        common(from, {within.first + parts_.margin, within.last + parts_.margin});
    const Index3 count = both.dims();
    Index3 at, to;  // the first of both, in either
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = both.first[axis] - from.first[axis];
      to[axis] = both.first[axis] - parts_.margin[axis] - within.first[axis];
    }
    values.visit([&](const auto* v) {
      for (int k = 0; k < count.k; ++k) {
        for (int j = 0; j < count.j; ++j) {
          const auto* row = v + values.index(at.i, at.j + j, at.k + k);
          float* out =
              &largest[to.i + std::size_t(n.i) * (to.j + j + std::size_t(n.j) * (to.k + k))];
          for (int i = 0; i < count.i; ++i) out[i] = std::max(out[i], static_cast<float>(row[i]));
        }
      }
    });
  }
  std::ranges::replace(largest, kNone, none);
  return largest;
}

Volume LabelFields::field(std::int64_t label) {
  const std::size_t l = index_of(label);
  std::vector<std::uint8_t> wanted(parts_.parts.size());
  for (const std::size_t part : parts_of(l)) {
    wanted[part] = 1;
    for (const LabelSamples& other : near(part)) wanted[static_cast<std::size_t>(other.label)] = 1;
  }
  weigh(std::move(wanted));
  const auto field_of = [&](std::size_t part) {
    const Rivals of = rivals(part, Others::all);
    const Index3 n = of.own.dims();
    std::vector<float> samples;
    samples.reserve(of.own.sample_count());
    for (int k = 0; k < n.k; ++k) {
      for (int j = 0; j < n.j; ++j) {
        for (int i = 0; i < n.i; ++i) {
          // A median may leave a sample to no label: it is outside.
          const auto rival = std::max(static_cast<float>(of.largest.sample(i, j, k)), kLeastRival);
          const auto own = static_cast<float>(parts_.parts[part].weight * of.own.sample(i, j, k));
          float ahead = own - rival;
          if (filter_.median == 0) {
            const Index3 at = of.box.first + Index3{i, j, k};
            const auto here = static_cast<std::size_t>(parts_.of_sample.sample(at.i, at.j, at.k));
            ahead = parts_.label_of[here] == l ? std::max(ahead, kAhead * rival)
                                               : std::min(ahead, -kAhead * own);
          }
          samples.push_back(ahead);
        }
      }
    }
    return volume_of(std::move(samples), of.own);
  };
  const SampleExtent within = box_of_label(l);
  return Volume::from_samples(grid_.cropped(within.first, within.dims()).of_type(SampleType::f32),
                              largest_of_parts(l, within, -kLeastRival, field_of));
}

Volume LabelFields::weighted(std::int64_t label) {
  weighed(label);
  const auto weighted_part = [&](std::size_t part) {
    const Volume own = smoothed(part, box(parts_.parts[part], 1));
    std::vector<float> samples(own.sample_count());
    own.visit([&](const auto* s) {
      for (std::size_t at = 0; at < samples.size(); ++at) {
        samples[at] = static_cast<float>(parts_.parts[part].weight * static_cast<double>(s[at]));
      }
    });
    return volume_of(std::move(samples), own);
  };
  const std::size_t l = index_of(label);
  const SampleExtent within = box_of_label(l);
  return Volume::from_samples(grid_.part(within.first, within.dims()).of_type(SampleType::f32),
                              largest_of_parts(l, within, 0, weighted_part));
}

std::vector<std::uint32_t> LabelFields::kept() const {
  std::vector<std::uint32_t> label;
  if (filter_.median > 0) return label;
  const Index3 n = grid_.dims(), margin = parts_.margin;
  label.reserve(grid_.sample_count());
  parts_.of_sample.visit([&](const auto* part) {
    for (int k = 0; k < n.k; ++k) {
      for (int j = 0; j < n.j; ++j) {
        const auto* row = part + parts_.of_sample.index(margin.i, j + margin.j, k + margin.k);
        for (int i = 0; i < n.i; ++i) {
          label.push_back(
              static_cast<std::uint32_t>(parts_.label_of[static_cast<std::size_t>(row[i])]));
        }
      }
    }
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
             for (int n = 0; n < kPointsOfVoxel && least < 0 && most >= 0; ++n) {
               inside += std::clamp(0.5 + (2 * kPointsOfOctant) * value_at(c, n) / (most - least), 0.0, 1.0);
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
