// SPDX-License-Identifier: MIT
#include "app/advice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace deliso {
namespace {

// Degrees. Of six CT volumes the smallest angle was .05 to 1.2 at seven isovalues that samples
// have, and 2.5 to 15, once .7, half a step lower.
constexpr double kThinAngle = 1;

// Samples. Smaller volumes are meshed at once, and are no scans.
constexpr std::size_t kLeastMask = 1000;

bool is_whole(double x) {
  return std::floor(x) == x;
}

}  // namespace

std::string mask_advice(const Input& input) {
  const Volume& volume = input.volume();
  const double lo = input.range->min, hi = input.range->max;
  const double isovalue = *input.isovalue, middle = lo + (hi - lo) / 2;
  const bool is_middle = std::abs(isovalue - middle) <= (hi - lo) / 4;
  if (volume.sample_count() < kLeastMask || input.field.is_filtered() || is_middle ||
      !(lo < isovalue && isovalue <= hi)) {
    return {};
  }
  const bool is_mask = volume.visit([&](const auto* samples) {
    return std::all_of(samples, samples + volume.sample_count(), [&](auto sample) {
      const auto value = static_cast<double>(sample);
      return value == lo || value == hi;
    });
  });
  if (!is_mask) return {};
  return text("all samples are ", lo, " or ", hi, ", as of a segmentation: --iso ", middle,
              " is half-way", is_whole(hi) ? text(", --label ", hi, " is smooth") : "");
}

std::string tie_advice(const MeshRun& run) {
  const std::optional<Volume>& volume = run.input.field.source.in_memory;
  const double isovalue = *run.input.isovalue;
  // Of integers the level lies off all samples (geometric_isovalue()).
  const SampleType type = run.input.grid().type();
  const bool is_float = type == SampleType::f32 || type == SampleType::f64;
  if (!volume || run.input.field.label || !is_float || run.triangles == 0 ||
      run.quality.min_angle >= kThinAngle || !is_whole(isovalue)) {
    return {};
  }
  bool equal = false;
  double below = -std::numeric_limits<double>::infinity();
  volume->visit([&](const auto* samples) {
    for (std::size_t n = 0; n < volume->sample_count(); ++n) {
      const auto value = static_cast<double>(samples[n]);
      equal |= value == isovalue;
      if (value < isovalue) below = std::max(below, value);
    }
  });
  if (!equal || !std::isfinite(below) || !is_whole(below)) return {};
  return text("samples equal the isovalue, which makes thin triangles: --iso ",
              below + (isovalue - below) / 2, " gives better ones");
}

std::string border_advice(std::span<const std::int64_t> labels) {
  if (labels.empty()) return {};
  return text(labels.size() == 1 ? "the mesh of label " : "the meshes of labels ",
              joined(labels, ", "), labels.size() == 1 ? " is" : " are",
              " open at the volume's border: --cap closes ", labels.size() == 1 ? "it" : "them");
}

}  // namespace deliso
