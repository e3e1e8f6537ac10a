// SPDX-License-Identifier: MIT
// The fields of labels that share borders. s_L is the smoothed indicator of label L, and w_L its
// weight. The field of L is
//
//   f_L = w_L s_L - max of w_M s_M over all other labels M,
//
// and the surface of L is {f_L = 0}. Two statements hold of the fields as they are, rounded:
//   1. At a sample where w_L s_L and w_M s_M are the two largest, f_M = -f_L. So L and M have the
//      same surface in voxels with eight such corners.
//   2. f_L + f_M <= 0 at all samples, hence at all points. So no point is inside two surfaces.
//
// The weights keep the volumes: with equal ones a Gaussian moves a surface towards its centers of
// curvature, and thin labels vanish. The largest label has weight 1; the others follow by size.
// Each has the weight at which it takes as much space from the larger labels as it leaves to them.
// Smaller labels are not asked: their share of a point, s_M, belongs to neither side. Where only
// two labels meet, w_L s_L = w_M s_M is s_L = w_M / (w_L + w_M), an isovalue of the indicator.
//
// So it is with the main part of each label (io/filter/label_parts.h). The weight of another part
// is found in the same way against all other labels with the weights of their main parts, and w_L
// s_L is the largest of the parts'. Labels of one size are weighed alike, and all sums are the same
// in a mirrored volume, up to what rounds to one weight. Beyond the box the outermost samples go
// on, also where volumes are measured.
//
// Without a median each sample stays with its label: there f_L is at least a fifth of the largest
// other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/filter/label_parts.h"
#include "io/filter/segmentation.h"
#include "volume/volume.h"

namespace deliso {

// What smooths an indicator: the median of a radius, then a Gaussian; in samples.
struct IndicatorFilter {
  int median = 0;
  Vec3 sigma{};
};

// How far a sample's own label is ahead there, at least, as a share of the largest other.
inline constexpr float kAhead = 0.2F;

class LabelFields {
 public:
  // `found` are all labels of the volume, in their order. Those of `united` count as one label,
  // named by the first of them. Throws as united_labels does. pre: the volume is no block.
  LabelFields(const Segmentation& samples, std::vector<LabelSamples> found,
              std::span<const std::int64_t> united, const IndicatorFilter& filter,
              std::string_view name, int threads);

  // Returns the label, with its weight. Cost: the Gaussians of all labels near it, and of the
  // larger labels near these, and so on.
  const LabelSamples& weighed(std::int64_t label);
  const std::vector<LabelSamples>& weighed();  // all labels
  // Returns f_L in float32, in a box around L beyond which it is negative. Memory: three times the
  // result, at most.
  Volume field(std::int64_t label);
  // Returns w_L s_L in float32, as a block of the volume in the same box: it is 0 beyond.
  Volume weighted(std::int64_t label);

  // Returns per sample the place of its label among all; nothing with a median.
  std::vector<std::uint32_t> kept() const;

 private:
  struct Rivals;

  std::size_t number_of(std::int64_t label) const;
  std::vector<std::size_t> parts_of(std::size_t label) const;
  SampleBox box(const LabelSamples& of) const;
  SampleBox in_larger(const SampleBox& box) const;
  SampleBox box_of_label(std::size_t label) const;
  Volume smoothed(const Volume& numbers, std::size_t number, const SampleBox& box,
                  int threads) const;
  std::vector<std::size_t> labels_near(const SampleBox& box) const;
  Rivals rivals(std::size_t part, bool is_larger_only, int threads) const;
  void weigh(std::vector<std::uint8_t> wanted);
  void weigh_parts(std::size_t label);
  bool is_larger(std::size_t m, std::size_t n) const;
  SampleBox grown(const SampleBox& box) const;
  void raise_to(std::size_t label, const SampleBox& box_of_values,
                std::vector<float>& values) const;

  Grid grid_;
  std::vector<LabelSamples> labels_;
  std::vector<std::int64_t> united_;
  IndicatorFilter filter_;
  Index3 reach_;  // of the filter, in samples
  std::string_view name_;
  int threads_;
  LabelParts parts_;
  std::vector<std::optional<Volume>> of_label_;  // smoothed, of labels that many parts ask for
};

// Returns the volume of {f >= 0} in voxels, found from 128 points of each.
double inside_volume(const Volume& field, int threads = 1);

}  // namespace deliso
